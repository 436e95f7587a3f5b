#include "core/json_file.h"

#include "core/error.h"
#include "core/file.h"

namespace gnomon {

nlohmann::ordered_json readJsonFile(const std::string& path) {
    try {
        return nlohmann::ordered_json::parse(readTextFile(path));
    } catch (const nlohmann::ordered_json::parse_error& error) {
        throw Error(atByte(path, error.byte), "not JSON", "a JSON document", "a syntax error");
    }
}

} // namespace gnomon

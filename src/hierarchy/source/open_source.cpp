#include "hierarchy/source/open_source.h"

#include "hierarchy/source/file_source.h"
#include "hierarchy/source/http_source.h"

#include <cctype>

namespace gnomon::hierarchy {

Access& commonAccess() {
    static Access access;
    return access;
}

bool isAddress(const std::string& name) {
    std::string start = name.substr(0, 8);
    for (char& letter : start)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return start.starts_with("http://") || start.starts_with("https://");
}

std::unique_ptr<Source> openSource(const std::string& name, const Access& access) {
    if (isAddress(name)) return std::make_unique<HttpSource>(name, access);
    return std::make_unique<FileSource>(name);
}

} // namespace gnomon::hierarchy

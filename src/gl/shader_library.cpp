#include "gl/shader_library.h"

#include "core/error.h"
#include "core/file.h"

#include <sstream>

namespace gnomon::gl {

std::string ShaderLibrary::text(std::string_view path) const {
    if (folder_) return readTextFile(*folder_ + "/" + std::string(path));
    const auto found = kEmbeddedShaders.find(path);
    if (found == kEmbeddedShaders.end()) throw Error(std::string(path), "no such shader");
    return std::string(found->second);
}

void ShaderLibrary::append(std::string_view path, std::map<std::string, bool>& seen, std::string& out) const {
    if (!seen.emplace(std::string(path), true).second) return;
    std::istringstream lines(text(path));
    constexpr std::string_view kInclude = "#include \"";
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kInclude)) {
            const std::string_view rest = std::string_view(line).substr(kInclude.size());
            append(rest.substr(0, rest.find('"')), seen, out);
        } else {
            out += line + "\n";
        }
    }
}

std::string ShaderLibrary::source(std::string_view path, std::string_view defines) const {
    std::string out = "#version 450 core\n" + std::string(defines);
    std::map<std::string, bool> seen;
    append(path, seen, out);
    return out;
}

} // namespace gnomon::gl

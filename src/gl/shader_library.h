// Finds the GLSL shader sources by their path below shaders/. They are embedded at compile time or read from a folder.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::gl {

extern const std::map<std::string_view, std::string_view> kEmbeddedShaders;

/// The GLSL shader sources, by their path below shaders/.
class ShaderLibrary {
public:
    /// Uses the files below `folder` if it is given, and otherwise the sources that are embedded in the program.
    explicit ShaderLibrary(std::optional<std::string> folder = std::nullopt) : folder_(std::move(folder)) {}

    /// Returns the shader source of `path`. The first line is `#version 450 core`, followed by `defines`. Each line
    /// `#include "PATH"` is replaced by the text of that file, but only once per file. Throws Error if a file is
    /// missing.
    std::string source(std::string_view path, std::string_view defines = {}) const;

private:
    std::string text(std::string_view path) const;
    void append(std::string_view path, std::map<std::string, bool>& seen, std::string& out) const;

    std::optional<std::string> folder_;
};

} // namespace gnomon::gl

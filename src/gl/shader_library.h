// The GLSL text under shaders/, by its path there: embedded when the program was built, or read from a folder.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::gl {

extern const std::map<std::string_view, std::string_view> kEmbeddedShaders;

/// Finds shader text by its path under shaders/.
class ShaderLibrary {
public:
    /// The embedded text, or the files under `folder` if it is given.
    explicit ShaderLibrary(std::optional<std::string> folder = std::nullopt) : folder_(std::move(folder)) {}

    /// The text of `path` with every `#include "PATH"` line replaced by that file's text, once each; the first line is
    /// `#version 450 core` and `defines` follow it. Throws Error if a file is missing.
    std::string source(std::string_view path, std::string_view defines = {}) const;

private:
    std::string text(std::string_view path) const;
    void append(std::string_view path, std::map<std::string, bool>& seen, std::string& out) const;

    std::optional<std::string> folder_;
};

} // namespace gnomon::gl

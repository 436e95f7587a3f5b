// The materials of an OBJ: libraries of Wavefront MTL, of which the diffuse colours are kept.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace gnomon::read {

/// Reads the libraries that an OBJ names, as it names them, and says which colour a face has.
class ObjMaterials {
public:
    /// `path` of the OBJ, in whose folder its libraries lie.
    explicit ObjMaterials(std::string path) : path_(std::move(path)) {}

    /// The OBJ is read from its beginning (again).
    void begin();

    /// What follows `mtllib`: names of files, which may have blanks in them, so that of all ways to join words the
    /// longest that is there counts. A name that leads out of the folder is none that is there. Throws Error that names
    /// line and library for a colour that is none.
    void addLibraries(std::string_view names);

    /// What follows `usemtl`; from here on faces have this material.
    void use(std::string_view name);

    /// RGBA8, red in the lowest byte, of the material in use; white without one. `Kd` counts as sRGB, as it is shown.
    std::uint32_t color() const { return color_; }

    /// Whether a face may have had a colour other than white.
    bool hasColors() const { return hasColors_; }

    /// What is missing, or is left out of the materials that are used, and how often.
    const std::map<std::string, std::uint64_t>& leftOut() const { return leftOut_; }

    /// The libraries that were read.
    const std::vector<std::string>& files() const { return files_; }

private:
    struct Material {
        std::uint32_t color = 0xFFFFFFFF;
        bool hasTexture = false;
        bool isUsed = false;
    };

    void readLibrary(const std::string& file);

    std::string path_;
    std::unordered_map<std::string, Material> materials_;
    std::vector<std::string> files_;
    std::map<std::string, std::uint64_t> leftOut_;
    std::uint32_t color_ = 0xFFFFFFFF;
    bool hasColors_ = false;
};

} // namespace gnomon::read

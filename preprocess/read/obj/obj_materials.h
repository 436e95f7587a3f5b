// Reads the materials of an OBJ file from Wavefront MTL libraries. Only diffuse colours are used.
#pragma once

#include "preprocess/read/obj/library_finder.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace gnomon::read {

/// Reads each material library of an OBJ file once, and returns the diffuse colours of its materials.
class ObjMaterials {
public:
    /// Prepares the materials of the OBJ file `path`. All libraries must be in the folder `sourceRoot` (see
    /// SourceRoot).
    ObjMaterials(const std::string& path, const std::string& sourceRoot) : finder_(path, sourceRoot) {}

    /// Reads the material libraries that `names`, the text after `mtllib`, refers to (see LibraryFinder). Throws Error
    /// with the library's path and line for an invalid colour. Throws Error, which names `where`, for a file outside
    /// the source root.
    void addLibraries(std::string_view names, const std::string& where);

    /// Counts one use of the material `name`, the text after `usemtl` in the OBJ file.
    void use(const std::string& name);

    /// Returns the diffuse colour (`Kd`) of the material `name` as RGBA8, red in the lowest byte. Returns white if no
    /// library defines the material. `Kd` is taken as sRGB, without conversion. A '#' can be part of the name or begin
    /// a comment, so the function tries the whole name first.
    std::uint32_t colorOf(const std::string& name) const;

    /// Returns true if the OBJ file uses a material with a colour other than white.
    bool hasColors() const { return hasColors_; }

    /// Returns the data that could not be used, by name: the numbers of missing libraries, of missing materials, and of
    /// unread statements of used materials.
    std::map<std::string, std::uint64_t> rejected() const;

    /// Returns the paths of the material libraries that were read.
    const std::vector<std::string>& files() const { return files_; }

    /// Returns a note for the user about inexact names of material libraries. The note is empty if there is nothing to
    /// report.
    const std::string& remark() const { return finder_.remark(); }

private:
    struct Material {
        std::uint32_t color = 0xFFFFFFFF;
        std::uint64_t rejected = 0; ///< bit i: whether its definition has the unread statement rejectedNames_[i]
        bool isUsed = false;
    };

    void readLibrary(const std::string& file);
    void readStatement(Material& material, const std::vector<std::string_view>& words, const std::string& where);
    Material& declared(const std::string& name);
    void reject(Material& material, const std::string& statement);
    template <class Materials>
    auto materialIn(Materials& materials, const std::string& name) const;
    bool useKnown(const std::string& name);

    LibraryFinder finder_;
    std::unordered_map<std::string, Material> materials_;
    std::unordered_map<std::string, std::string> fullNames_; ///< full name per name without comment
    std::vector<std::string> files_;
    std::vector<std::string> rejectedNames_{"other material statements"};
    std::map<std::string, std::uint64_t> rejected_;
    std::map<std::string, std::uint64_t> unknown_; ///< number of uses per material that no library has defined so far
    std::uint64_t missing_ = 0; ///< number of uses of undefined materials that do not fit into `unknown_`
    bool hasColors_ = false;
};

} // namespace gnomon::read

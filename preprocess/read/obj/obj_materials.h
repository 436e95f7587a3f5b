// The materials of an OBJ: libraries of Wavefront MTL, of which the diffuse colours are kept.
#pragma once

#include "preprocess/read/obj/library_finder.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace gnomon::read {

/// Reads each library that an OBJ names once, and says which colour a face has.
class ObjMaterials {
public:
    /// Of the OBJ `path`. `sourceRoot` is the folder that libraries may come from (see SourceRoot).
    ObjMaterials(const std::string& path, const std::string& sourceRoot) : finder_(path, sourceRoot) {}

    /// Reads the libraries `names`, which follow `mtllib` (see LibraryFinder). Throws Error that names line and library
    /// for a colour that is none, and Error at `where` for a file outside of the source root.
    void addLibraries(std::string_view names, const std::string& where);

    /// Counts a use of material `name`, which follows `usemtl`.
    void use(const std::string& name);

    /// Returns the colour of material `name` as RGBA8, red in the lowest byte; white if no library has it. `Kd` counts
    /// as sRGB, as it is shown. A '#' may belong to the name or begin a comment: the whole name comes first.
    std::uint32_t colorOf(const std::string& name) const;

    /// Returns whether a material that is used has a colour other than white.
    bool hasColors() const { return hasColors_; }

    /// Returns what is missing, or is left out of the materials that are used, and how often.
    std::map<std::string, std::uint64_t> leftOut() const;

    /// The libraries that were read.
    const std::vector<std::string>& files() const { return files_; }

    /// Returns what a user should know of the libraries; empty for nothing.
    const std::string& remark() const { return finder_.remark(); }

private:
    struct Material {
        std::uint32_t color = 0xFFFFFFFF;
        std::uint64_t leftOut = 0; ///< bit by bit the statements of leftOutNames_
        bool isUsed = false;
    };

    void readLibrary(const std::string& file);
    void readStatement(Material& material, const std::vector<std::string_view>& words, const std::string& where);
    Material& declared(const std::string& name);
    void leaveOut(Material& material, const std::string& statement);
    template <class Materials>
    auto materialIn(Materials& materials, const std::string& name) const;
    bool useKnown(const std::string& name);

    LibraryFinder finder_;
    std::unordered_map<std::string, Material> materials_;
    std::unordered_map<std::string, std::string> fullNames_; ///< by names without comments
    std::vector<std::string> files_;
    std::vector<std::string> leftOutNames_{"other material statements"};
    std::map<std::string, std::uint64_t> leftOut_;
    std::map<std::string, std::uint64_t> unknown_; ///< uses of materials before a library has them
    std::uint64_t missing_ = 0;                    ///< uses beyond those of unknown_
    bool hasColors_ = false;
};

} // namespace gnomon::read

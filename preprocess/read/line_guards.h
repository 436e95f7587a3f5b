// The lines that OBJ, STL and OFF files may have, one guard a format.
#pragma once

#include "preprocess/read/guarded_stream.h"
#include "preprocess/read/obj/obj_materials.h"

#include <cstdint>
#include <map>
#include <vector>

namespace gnomon::read {

/// Wavefront OBJ: passes `v`, `vn`, `vc` and `f`, joins continued lines, reads the materials, leaves the rest out.
/// Indices are checked for form only: their range is known when all vertices are.
class ObjGuard final : public LineGuard {
public:
    /// Of the OBJ `path`, in whose folder its materials lie.
    explicit ObjGuard(const std::string& path = {}) : materials_(path) {}

    /// As they are at the line in hand.
    const ObjMaterials& materials() const { return materials_; }

    void begin() override;
    std::optional<std::string> pass(std::string_view line, const std::string& where) override;
    void end(const std::string& where) override;

    /// The vertices of the face of the line in hand, counted from 0; one that the file does not have is beyond its end.
    const std::vector<std::uint64_t>& corners() const { return corners_; }

    /// Whether the line in hand goes on in the next.
    bool isContinued() const { return !continued_.empty(); }

    /// Lines that declare a face, in the pass that is running or over.
    std::uint64_t faceLines() const { return faceLines_; }

    /// What the pass that is running or over has left out, and how many lines of it.
    const std::map<std::string, std::uint64_t>& leftOut() const { return leftOut_; }

private:
    void takeFace(const std::vector<std::string_view>& words, const std::string& where);
    void tellMaterials(std::string_view line);

    ObjMaterials materials_;
    std::string continued_;
    std::map<std::string, std::uint64_t> leftOut_;
    std::vector<std::uint64_t> corners_;
    std::uint64_t vertexLines_ = 0;
    std::uint64_t faceLines_ = 0;
};

/// Ascii STL: passes facets without their normals, in the order that the format demands.
class StlGuard final : public LineGuard {
public:
    std::optional<std::string> pass(std::string_view line, const std::string& where) override;
    void end(const std::string& where) override;

    std::uint64_t facets() const { return facets_; }

private:
    std::uint64_t facets_ = 0;
    int verticesToCome_ = 0;
    bool isInSolid_ = false;
};

/// Ascii OFF: leaves out comments, empty lines and the colours of faces, puts the counts on a line of their own, and
/// sees to it that each vertex and each face has a line of its own with the values that the header announces.
class OffGuard final : public LineGuard {
public:
    /// Faces with a colour of their own, so far.
    std::uint64_t coloredFaces() const { return coloredFaces_; }

    std::optional<std::string> pass(std::string_view line, const std::string& where) override;
    void end(const std::string& where) override;

private:
    void readCounts(const std::vector<std::string_view>& words, const std::string& where);
    std::string vertex(const std::vector<std::string_view>& words, const std::string& where);
    std::string face(const std::vector<std::string_view>& words, const std::string& where);

    bool hasHeader_ = false;
    bool hasCounts_ = false;
    bool hasNormals_ = false;
    bool hasColors_ = false;
    bool hasTexcoords_ = false;
    std::uint64_t coloredFaces_ = 0;
    std::uint64_t verticesToCome_ = 0;
    std::uint64_t facesToCome_ = 0;
};

} // namespace gnomon::read

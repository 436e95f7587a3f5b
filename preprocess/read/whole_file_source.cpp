#include "preprocess/read/whole_file_source.h"

#include "core/error.h"
#include "preprocess/read/face_importer.h"
#include "preprocess/read/line_guards.h"
#include "preprocess/read/obj/obj_source.h"
#include "preprocess/read/ply/ply_face_colors.h"
#include "preprocess/read/words.h"

#include <OpenMesh/Core/IO/reader/OBJReader.hh>
#include <OpenMesh/Core/IO/reader/OFFReader.hh>
#include <OpenMesh/Core/IO/reader/STLReader.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include <algorithm>
#include <array>
#include <cstring>
#include <istream>

namespace gnomon::read {

namespace {

using OpenMesh::IO::Options;

// Arrays of ours, what the readers hold beside them, and the slack of growing vectors: an OBJ of the shortest lines is
// the worst, 8 bytes for a vertex or a triangle.
constexpr std::uint64_t kBytesPerFileByte = 12;

// An OBJ that would take more than that part of the memory is streamed instead: a build needs room beside it.
constexpr std::uint64_t kStreamedShare = 4;

constexpr std::uint64_t kStlHeader = 84;
constexpr std::uint64_t kStlFacet = 50;

// OpenMesh's own messages would be output below `app`; what they say comes out as an Error.
class QuietOpenMesh {
public:
    QuietOpenMesh() { omerr().disable(); }

    ~QuietOpenMesh() { omerr().enable(); }

    QuietOpenMesh(const QuietOpenMesh&) = delete;
    QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;
    QuietOpenMesh(QuietOpenMesh&&) = delete;
    QuietOpenMesh& operator=(QuietOpenMesh&&) = delete;
};

Options everythingOfVertices() {
    Options options;
    options += Options::VertexNormal;
    options += Options::VertexColor;
    return options;
}

// What is thrown below the stream always comes through; `failures` says which states of the stream end the reading too.
template <class Buffer>
void readWith(
    OpenMesh::IO::BaseReader& reader,
    Buffer& buffer,
    FaceImporter& importer,
    Options options,
    std::ios::iostate failures) {
    std::istream stream(&buffer);
    stream.exceptions(std::ios::badbit | failures);
    try {
        if (!reader.read(stream, importer, options)) throw Error(buffer.where(), "cannot be understood");
    } catch (const std::ios_base::failure&) {
        throw Error(buffer.where(), "not a number, or the file ends too early");
    }
}

/// `mesh` with the colours of its faces; a vertex is split where they differ.
MemoryMesh withFaceColors(
    MemoryMesh mesh, const std::vector<std::uint32_t>& colors, const std::string& path, Bytes memoryLimit) {
    FaceColorSplitter splitter(path, memoryLimit, {});
    splitter.addVertices({0, mesh.positions, mesh.normals, {}, {}});
    std::size_t first = 0;
    for (std::size_t face = 0; face < mesh.faceSizes.size(); ++face) {
        splitter.addFace(std::span(mesh.corners).subspan(first, mesh.faceSizes[face]), colors[face]);
        first += mesh.faceSizes[face];
    }
    return splitter.take();
}

MemoryMesh readObj(const InputFile& file, Bytes memoryLimit) {
    ObjGuard guard(file.path());
    const ObjMaterials& materials = guard.materials();
    GuardedLines lines(file, guard);
    FaceImporter importer(
        [&] { return lines.where(); }, {[&] { return materials.color(); }, [&] { return std::span(guard.corners()); }});
    readWith(OpenMesh::IO::OBJReader(), lines, importer, everythingOfVertices(), std::ios::goodbit);
    MemoryMesh mesh = importer.take();
    const std::uint64_t notAPolygon = guard.faceLines() - mesh.faceSizes.size();
    std::map<std::string, std::uint64_t> leftOut = guard.leftOut();
    leftOut.insert(materials.leftOut().begin(), materials.leftOut().end());
    if (mesh.faceSizes.empty()) return mesh;
    if (materials.hasColors() && mesh.colors.empty())
        mesh = withFaceColors(std::move(mesh), importer.takeFaceColors(), file.path(), memoryLimit);
    else if (materials.hasColors())
        leftOut["colours of materials, beside those of vertices"] = mesh.faceSizes.size();
    mesh.notAPolygon = notAPolygon;
    mesh.attributesDropped = std::move(leftOut);
    mesh.filesBesides = materials.files();
    return mesh;
}

MemoryMesh readOff(const InputFile& file) {
    // This call also makes the reader remember which values the header announces.
    if (!OpenMesh::IO::OFFReader().can_u_read(file.path()))
        throw Error(atLine(file.path(), 1), "not an OFF file with three coordinates a vertex");
    std::string head(std::min<std::uint64_t>(file.size(), 80), '\0');
    file.readAt(0, std::as_writable_bytes(std::span(head)));
    const std::string_view firstLine = std::string_view(head).substr(0, head.find('\n'));
    // Inside faces the reader never asks whether the stream still gives anything.
    constexpr std::ios::iostate kFailures = std::ios::failbit;
    if (firstLine.find("BINARY") != std::string_view::npos) {
        GuardedBytes bytes(file);
        FaceImporter importer([&] { return bytes.where(); });
        readWith(OpenMesh::IO::OFFReader(), bytes, importer, everythingOfVertices(), kFailures);
        return importer.take();
    }
    OffGuard guard;
    GuardedLines lines(file, guard);
    FaceImporter importer([&] { return lines.where(); });
    readWith(OpenMesh::IO::OFFReader(), lines, importer, everythingOfVertices(), kFailures);
    lines.readOut();
    MemoryMesh mesh = importer.take();
    if (guard.coloredFaces() > 0) mesh.attributesDropped["face colours"] = guard.coloredFaces();
    return mesh;
}

// The facets of a binary STL, if the file's size says that it is one.
std::optional<std::uint64_t> binaryFacets(const InputFile& file) {
    if (file.size() < kStlHeader) return std::nullopt;
    std::array<std::byte, kStlHeader> header{};
    file.readAt(0, header);
    std::uint32_t count = 0;
    for (std::size_t i = 4; i-- > 0;)
        count = count << 8U | std::to_integer<std::uint32_t>(header[80 + i]);
    if (file.size() == kStlHeader + kStlFacet * count) return count;
    if (std::memcmp(header.data(), "solid", 5) == 0 && file.size() < kStlHeader + kStlFacet * count)
        return std::nullopt;
    throw Error(
        atByte(file.path(), file.size()),
        "neither ascii nor binary STL",
        std::to_string(kStlHeader + kStlFacet * count) + " bytes for " + std::to_string(count) + " facets",
        std::to_string(file.size()));
}

MemoryMesh readStl(const InputFile& file) {
    if (const std::optional<std::uint64_t> facets = binaryFacets(file)) {
        GuardedBytes bytes(file);
        FaceImporter importer([&] { return bytes.where(); });
        Options options;
        options += Options::Binary;
        readWith(OpenMesh::IO::STLReader(), bytes, importer, options, std::ios::failbit);
        MemoryMesh mesh = importer.take();
        mesh.notAPolygon = *facets - mesh.faceSizes.size();
        return mesh;
    }
    StlGuard guard;
    GuardedLines lines(file, guard);
    FaceImporter importer([&] { return lines.where(); });
    readWith(OpenMesh::IO::STLReader(), lines, importer, Options(), std::ios::goodbit);
    MemoryMesh mesh = importer.take();
    mesh.notAPolygon = guard.facets() - mesh.faceSizes.size();
    return mesh;
}

} // namespace

bool isWholeFileFormat(const std::string& path) {
    const std::string suffix = loweredSuffix(path);
    return suffix == ".obj" || suffix == ".stl" || suffix == ".off";
}

std::unique_ptr<MeshSource> readWholeFile(const std::string& path, Bytes memoryLimit) {
    const InputFile file(path);
    const Bytes needed{file.size() * kBytesPerFileByte};
    const std::string suffix = loweredSuffix(path);
    if (suffix == ".obj" && needed.count > memoryLimit.count / kStreamedShare) return streamObj(path, memoryLimit);
    if (needed > memoryLimit)
        throw Error(
            path,
            "too large for a format that is read whole (convert it to PLY, which is streamed)",
            "at most " + readableBytes(memoryLimit) + " of memory",
            "a need for up to " + readableBytes(needed));
    const QuietOpenMesh quiet;
    MemoryMesh mesh = suffix == ".obj" ? readObj(file, memoryLimit) : suffix == ".stl" ? readStl(file) : readOff(file);
    file.requireUnchanged();
    return memorySource(path, file.size(), std::move(mesh));
}

} // namespace gnomon::read

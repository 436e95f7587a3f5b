// Makes the seeds that are bytes: models, their pages, .glb and images. The others were written by hand.
// usage: fuzz_seeds FOLDER    writes FOLDER/model/*, FOLDER/page/*, FOLDER/gltf/* and FOLDER/image/*
#include "core/error.h"
#include "core/random.h"
#include "hierarchy/bytes.h"
#include "hierarchy/file_layout.h"
#include "hierarchy/model_writer.h"
#include "hierarchy/page_codec.h"
#include "resealed.h"
#include "tests/support/gltf_maker.h"
#include "tests/support/tiny_model.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include <meshoptimizer.h>
#include <png.h>
#include <turbojpeg.h>
#include <zstd.h>

namespace gnomon::fuzz {
namespace {

using namespace hierarchy;

void write(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// The stored bytes of a page as they are without zstd.
std::vector<std::byte> unpacked(std::span<const std::byte> stored) {
    ByteReader in(stored);
    const auto packing = in.take<std::uint8_t>();
    if ((packing & 1U) == 0) return {stored.begin(), stored.end()};
    std::vector<std::byte> plain(in.takeVarint());
    const auto rest = in.take(in.remaining());
    if (ZSTD_decompress(plain.data(), plain.size(), rest.data(), rest.size()) != plain.size())
        throw Error("a page that was just packed cannot be unpacked");
    ByteWriter out;
    out.put(static_cast<std::uint8_t>(packing & ~1U));
    out.putVarint(plain.size());
    out.put(plain);
    return out.take();
}

/// A model whose pages are unpacked.
std::vector<std::byte> modelOf(const tests::TinyModel& model, std::span<const EncodedPage> pages) {
    ByteWriter out;
    out.put(encodeHeader(flagsOf(model.summary), {}));
    std::vector<PageInfo> rows;
    for (const EncodedPage& page : pages) {
        out.put(page.bytes);
        rows.push_back(page.info);
    }
    Footer footer;
    footer.pageTable.offset = out.size();
    out.put(encodePageTable(rows));
    footer.pageTable.bytes = out.size() - footer.pageTable.offset;
    footer.summary.offset = out.size();
    out.put(encodeSummary(model.summary));
    footer.pageCount = rows.size();
    out.put(encodeFooter(footer));
    return resealed(out.bytes());
}

/// Two fields of 5 and 16 bits at each vertex.
PageFields fieldsOf(const Page& page) {
    PageFields fields;
    fields.layout.bits = {5, 16};
    for (const Vertex& vertex : page.vertices)
        fields.words.push_back(static_cast<std::uint32_t>(mix64(vertex.position.x) >> 43U));
    return fields;
}

void writeModel(const std::filesystem::path& folder, const std::string& name, tests::TinyModel model, bool hasFields) {
    if (hasFields) model.summary.fields = {{"heat", -1, 1, 5}, {"age", 0, 1e6, 16}};
    std::vector<EncodedPage> pages;
    for (const Page& page : model.pages) {
        pages.push_back(encodePage(page, hasFields ? fieldsOf(page) : PageFields()));
        pages.back().bytes = unpacked(pages.back().bytes);
        pages.back().info.storedBytes = static_cast<std::uint32_t>(pages.back().bytes.size());
        ByteWriter row;
        putPageRow(row, pages.back().info);
        row.put(pages.back().bytes);
        write(folder / "page" / (name + "_" + std::to_string(pages.size()) + ".seed"), row.bytes());
    }
    write(folder / "model" / (name + ".seed"), modelOf(model, pages));
}

void writeModels(const std::filesystem::path& folder) {
    int number = 0;
    for (const bool isColored : {false, true})
        for (const unsigned exponent : {1U, 3U}) {
            tests::TinyModelOptions options;
            options.gridExponent = exponent;
            options.clusterTriangles = 16;
            options.normals = options.colors = isColored;
            options.attributeErrorFrom = isColored ? 0.5 : -1;
            const std::string name = std::to_string(number++);
            writeModel(folder, name, tests::makeTinyModel(options), false);
            if (isColored) writeModel(folder, name + "_fields", tests::makeTinyModel(options), true);
        }
}

void writeGltf(const std::filesystem::path& folder) {
    read::GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5F});
    maker.attributes()["NORMAL"] = maker.addVectors({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    maker.attributes()["COLOR_0"] =
        maker.add<std::uint8_t>({255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 255}, "VEC4", 5121, 4);
    maker.primitive()["indices"] = maker.add<std::uint16_t>({0, 1, 2, 2, 1, 3}, "SCALAR", 5123, 1);
    const std::string text = maker.container();
    write(folder / "gltf" / "quad.seed", std::as_bytes(std::span(text)));
}

/// A view of `count` elements of `stride` bytes that EXT_meshopt_compression packs, in place of the maker's `view`.
void packView(
    read::GltfMaker& maker, std::size_t view, const std::vector<unsigned char>& packed, read::GltfMaker::json how) {
    maker.add(packed, "SCALAR", 5121, 1);
    const auto& held = maker.document["bufferViews"].back();
    how.update({{"buffer", 0}, {"byteOffset", held["byteOffset"]}, {"byteLength", held["byteLength"]}});
    maker.document["bufferViews"][view]["extensions"]["EXT_meshopt_compression"] = how;
}

/// Positions, octahedral normals and indices, all packed: as triangles or as a sequence.
void writePackedGltf(const std::filesystem::path& folder, bool isSequence) {
    const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5F};
    const std::vector<std::int8_t> normals = {0, 0, 127, 0, 9, 0, 127, 0, 0, 9, 127, 0, 5, 5, 127, 0};
    const std::vector<std::uint32_t> corners = {0, 1, 2, 2, 1, 3};
    read::GltfMaker maker;
    maker.attributes()["POSITION"] = maker.addVectors(positions);
    maker.attributes()["NORMAL"] = maker.add(normals, "VEC3", 5120, 4);
    maker.document["accessors"][1]["normalized"] = true;
    maker.document["bufferViews"][1]["byteStride"] = 4;
    maker.primitive()["indices"] = maker.add(corners, "SCALAR", 5125, 1);
    const auto packedVertices = [](const void* from, std::size_t count, std::size_t stride) {
        std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(count, stride));
        packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), from, count, stride));
        return packed;
    };
    packView(
        maker, 0, packedVertices(positions.data(), 4, 12), {{"mode", "ATTRIBUTES"}, {"count", 4}, {"byteStride", 12}});
    packView(
        maker,
        1,
        packedVertices(normals.data(), 4, 4),
        {{"mode", "ATTRIBUTES"}, {"count", 4}, {"byteStride", 4}, {"filter", "OCTAHEDRAL"}});
    std::vector<unsigned char> packed(
        isSequence ? meshopt_encodeIndexSequenceBound(corners.size(), 4)
                   : meshopt_encodeIndexBufferBound(corners.size(), 4));
    packed.resize(
        isSequence ? meshopt_encodeIndexSequence(packed.data(), packed.size(), corners.data(), corners.size())
                   : meshopt_encodeIndexBuffer(packed.data(), packed.size(), corners.data(), corners.size()));
    packView(
        maker,
        2,
        packed,
        {{"mode", isSequence ? "INDICES" : "TRIANGLES"}, {"count", corners.size()}, {"byteStride", 4}});
    maker.document["extensionsRequired"] = {"EXT_meshopt_compression"};
    const std::string text = maker.container();
    write(
        folder / "gltf" / (isSequence ? "packed_sequence.seed" : "packed_triangles.seed"),
        std::as_bytes(std::span(text)));
}

/// Images of 8x8 pixels: PNG with and without colours and alpha, JPEG with colours at full and half resolution.
void writeImages(const std::filesystem::path& folder) {
    constexpr int kSide = 8;
    std::vector<std::uint8_t> pixels(std::size_t{kSide} * kSide * 4);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = static_cast<std::uint8_t>(i * 37);
    const auto keep = [&](const std::string& name, const auto* bytes, std::size_t count) {
        write(folder / "image" / name, std::as_bytes(std::span(bytes, count)));
    };
    for (const png_uint_32 format :
         std::initializer_list<png_uint_32>{PNG_FORMAT_GRAY, PNG_FORMAT_RGB, PNG_FORMAT_RGBA}) {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        image.width = image.height = kSide;
        image.format = format;
        std::vector<std::uint8_t> encoded(PNG_IMAGE_PNG_SIZE_MAX(image));
        png_alloc_size_t size = encoded.size();
        if (png_image_write_to_memory(&image, encoded.data(), &size, 0, pixels.data(), 0, nullptr) == 0)
            throw Error(static_cast<const char*>(image.message));
        keep("png_" + std::to_string(format) + ".seed", encoded.data(), size);
    }
    for (const int subsampling : {TJSAMP_444, TJSAMP_420, TJSAMP_GRAY}) {
        const std::unique_ptr<void, int (*)(void*)> compressor(tjInitCompress(), tjDestroy);
        unsigned char* encoded = nullptr;
        unsigned long size = 0;
        constexpr int kQuality = 75;
        const int failed = tjCompress2(
            compressor.get(), pixels.data(), kSide, 0, kSide, TJPF_RGBA, &encoded, &size, subsampling, kQuality, 0);
        const std::unique_ptr<unsigned char, void (*)(unsigned char*)> owner(encoded, tjFree);
        if (failed != 0) throw Error(tjGetErrorStr2(compressor.get()));
        keep("jpeg_" + std::to_string(subsampling) + ".seed", encoded, size);
    }
}

} // namespace
} // namespace gnomon::fuzz

int main(int count, char** words) {
    if (count != 2) return 2;
    try {
        gnomon::fuzz::writeModels(words[1]);
        gnomon::fuzz::writeGltf(words[1]);
        for (const bool isSequence : {false, true})
            gnomon::fuzz::writePackedGltf(words[1], isSequence);
        gnomon::fuzz::writeImages(words[1]);
    } catch (const std::exception& error) {
        static_cast<void>(std::fprintf(stderr, "fuzz_seeds: %s\n", error.what()));
        return 1;
    }
    return 0;
}

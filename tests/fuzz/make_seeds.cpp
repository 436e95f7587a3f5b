// Makes the seeds that are bytes: models, their pages and .glb. The others were written by hand.
// usage: fuzz_seeds FOLDER    writes FOLDER/model/*, FOLDER/page/* and FOLDER/gltf/*
#include "core/error.h"
#include "hierarchy/bytes.h"
#include "hierarchy/file_layout.h"
#include "hierarchy/model_writer.h"
#include "hierarchy/page_codec.h"
#include "hierarchy/tiny_model.h"
#include "resealed.h"
#include "tests/read/gltf_maker.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

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

void writeModels(const std::filesystem::path& folder) {
    int number = 0;
    for (const bool isColored : {false, true})
        for (const unsigned exponent : {1U, 3U}) {
            tests::TinyModelOptions options;
            options.gridExponent = exponent;
            options.clusterTriangles = 16;
            options.normals = options.colors = isColored;
            options.attributeErrorFrom = isColored ? 0.5 : -1;
            const tests::TinyModel model = tests::makeTinyModel(options);
            std::vector<EncodedPage> pages;
            for (const Page& page : model.pages) {
                pages.push_back(encodePage(page));
                pages.back().bytes = unpacked(pages.back().bytes);
                pages.back().info.storedBytes = static_cast<std::uint32_t>(pages.back().bytes.size());
                ByteWriter row;
                putPageRow(row, pages.back().info);
                row.put(pages.back().bytes);
                write(
                    folder / "page" / (std::to_string(number) + "_" + std::to_string(pages.size()) + ".seed"),
                    row.bytes());
            }
            write(folder / "model" / (std::to_string(number++) + ".seed"), modelOf(model, pages));
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

} // namespace
} // namespace gnomon::fuzz

int main(int count, char** words) {
    if (count != 2) return 2;
    try {
        gnomon::fuzz::writeModels(words[1]);
        gnomon::fuzz::writeGltf(words[1]);
    } catch (const std::exception& error) {
        static_cast<void>(std::fprintf(stderr, "fuzz_seeds: %s\n", error.what()));
        return 1;
    }
    return 0;
}

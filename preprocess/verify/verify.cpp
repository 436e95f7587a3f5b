#include "preprocess/verify/verify.h"

#include "core/error.h"
#include "core/heap.h"
#include "hierarchy/source/open_source.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/verify/cracks.h"
#include "preprocess/verify/error_bound.h"
#include "preprocess/verify/rules.h"
#include "preprocess/verify/source_soup.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace gnomon::verify {

namespace {

constexpr std::size_t kMaxLevels = 62; // LockedEdges stores a set of levels in one 64-bit word

Check checkChecksums(const hierarchy::ModelFile& file, const ModelFacts& model) {
    Check check{"checksums"};
    check.tested = model.pages.size();
    check.failed = model.damage.size();
    if (check.failed > 0) check.detail = model.damage[0];
    const std::string hash = file.computedContentHash();
    check.test(hash == file.contentHash(), [&] {
        return file.path() + ": content hash: expected " + file.contentHash() + ", found " + hash;
    });
    return check;
}

Check skippedCheck(const std::string& name, const std::string& why) {
    Check check{name};
    check.detail = "not checked: " + why;
    return check;
}

void skipChecks(Verification& verification, const std::vector<std::string>& names, const std::string& why) {
    for (const std::string& name : names)
        verification.checks.push_back(skippedCheck(name, why));
}

/// Returns the max number of threads that can decode pages in half of the free memory. The free memory does not include
/// the ModelFacts.
std::size_t threadsFor(const hierarchy::ModelFile& file, Bytes memory) {
    std::uint64_t page = 1;
    for (const hierarchy::PageInfo& info : file.pages())
        page = std::max(page, hierarchy::decodedPageBytes(info) + info.storedBytes);
    const std::uint64_t facts = factsBytes(file.pages()).count;
    requireRoom({facts + 2 * page}, memory, file.path(), "the facts of its pages");
    const std::uint64_t room = memory.count - residentSize().count - facts;
    const auto maxThreads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(room / 2 / page, 1, maxThreads));
}

Check checkCracksWithin(
    const hierarchy::ModelFile& file,
    const ModelFacts& model,
    const VerifyOptions& options,
    std::size_t threads,
    Progress& progress) {
    // The bytes for stored pages during their decoding, and for page tables.
    constexpr std::uint64_t kOther = std::uint64_t{8} << 20U;
    const std::uint64_t others = kOther + cutBytes(options.cuts);
    const std::uint64_t taken = residentSize().count + others;
    const Bytes room{options.memory.count - std::min(options.memory.count, taken)};
    const std::vector<CrackCell> cells = crackCells(file.pages(), room, threads);
    std::uint64_t largest = 0;
    for (const CrackCell& cell : cells)
        largest = std::max(largest, cell.bytes);
    requireRoom({others + largest}, options.memory, file.path(), "looking for cracks");
    return checkCracks(file, model, options.cuts, options.seed, cells, progress);
}

/// Returns the memory in bytes for comparing the model with its source: the model, the source, the cuts and their
/// trees.
Bytes comparisonBytes(const hierarchy::ModelFile& file, const read::MeshSummary& source) {
    constexpr std::uint64_t kSamples = std::uint64_t{48} << 20U;
    constexpr std::uint64_t kTreeBytes = 56; // bytes per triangle for its node, its entry in the order, and its centre
    const auto soup = [](std::uint64_t vertices, std::uint64_t triangles) {
        return vertices * sizeof(glm::dvec3) + triangles * sizeof(std::array<std::uint32_t, 3>);
    };
    const std::uint64_t triangles = std::max(source.faceCount, source.likelyTriangles);
    std::uint64_t model = 0;
    std::uint64_t finestVertices = 0;
    std::uint64_t finestTriangles = 0;
    for (const hierarchy::PageInfo& info : file.pages()) {
        model += hierarchy::decodedPageBytes(info);
        if (info.level > 0) continue;
        finestVertices += info.vertexCount;
        finestTriangles += info.triangleCount;
    }
    return {
        kSamples + model + source.heldBytes + soup(source.vertexCount, triangles) + kTreeBytes * triangles +
        2 * soup(finestVertices, finestTriangles) + kTreeBytes * finestTriangles};
}

} // namespace

Verification verifyModel(const VerifyOptions& options, Progress& progress) {
    Verification verification;
    std::unique_ptr<hierarchy::Source> source = hierarchy::openSource(options.model);
    std::vector<std::string> rest = {"structure", "nesting", "monotone_error", "cracks"};
    if (!options.source.empty()) rest.emplace_back("error_bound");
    std::optional<hierarchy::ModelFile> file;
    try {
        file.emplace(std::move(source));
    } catch (const Error& error) {
        verification.checks.push_back({"checksums", 1, 1, 0, error.what()});
        skipChecks(verification, rest, "the tables are damaged");
        return verification;
    }
    requireBelievable(*file);
    const std::size_t threads = threadsFor(*file, options.memory);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const ModelFacts model = readFacts(*file, progress);
    verification.checks.push_back(checkChecksums(*file, model));
    if (!model.damage.empty()) {
        skipChecks(verification, rest, "pages are damaged");
        return verification;
    }
    verification.checks.push_back(checkStructure(model));
    verification.checks.back().test(model.summary.levels.size() <= kMaxLevels, [&] {
        return options.model + ": levels: expected at most " + std::to_string(kMaxLevels) + ", found " +
               std::to_string(model.summary.levels.size());
    });
    if (!refinementsResolve(model) || model.summary.levels.size() > kMaxLevels) {
        skipChecks(verification, {rest.begin() + 1, rest.end()}, "the structure is broken");
        return verification;
    }
    verification.checks.push_back(checkNesting(model));
    verification.checks.push_back(checkMonotoneError(model));
    verification.checks.push_back(checkCracksWithin(*file, model, options, threads, progress));
    if (options.source.empty()) return verification;
    const auto mesh =
        read::openMeshSources(options.source, options.memory, {}, read::Textures::Bake, options.sourceRoot);
    requireRoom(comparisonBytes(*file, mesh->summary()), options.memory, options.model, "comparing it with its source");
    progress.stage("read the source", "triangles", mesh->summary().faceCount);
    const TriangleSoup soup = readSoup(*mesh, model.summary.grid, progress);
    verification.checks.push_back(checkErrorBound(loadModel(*file, progress), soup, options.seed, progress));
    return verification;
}

} // namespace gnomon::verify

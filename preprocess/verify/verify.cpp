#include "preprocess/verify/verify.h"

#include "core/error.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/verify/cracks.h"
#include "preprocess/verify/error_bound.h"
#include "preprocess/verify/rules.h"
#include "preprocess/verify/source_soup.h"
#include "storage/open_source.h"

#include <memory>
#include <utility>

namespace gnomon::verify {

namespace {

constexpr std::size_t kMostLevels = 62; // a cut marks levels in the bits of one word

constexpr Bytes kLeastPages = mebibytes(64);

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

Check leftOut(const std::string& name, const std::string& why) {
    Check check{name};
    check.detail = "not checked: " + why;
    return check;
}

void leaveOut(Verification& verification, const std::vector<std::string>& names, const std::string& why) {
    for (const std::string& name : names)
        verification.checks.push_back(leftOut(name, why));
}

} // namespace

Verification verifyModel(const VerifyOptions& options, Progress& progress) {
    Verification verification;
    std::unique_ptr<storage::Source> source = storage::openSource(options.model);
    std::vector<std::string> rest = {"structure", "nesting", "monotone_error", "cracks"};
    if (!options.source.empty()) rest.emplace_back("error_bound");
    std::optional<hierarchy::ModelFile> file;
    try {
        file.emplace(std::move(source));
    } catch (const Error& error) {
        verification.checks.push_back({"checksums", 1, 1, 0, error.what()});
        leaveOut(verification, rest, "the tables are damaged");
        return verification;
    }
    requireBelievable(*file);
    const ModelFacts model = readFacts(*file, progress);
    verification.checks.push_back(checkChecksums(*file, model));
    if (!model.damage.empty()) {
        leaveOut(verification, rest, "pages are damaged");
        return verification;
    }
    verification.checks.push_back(checkStructure(model));
    verification.checks.back().test(model.summary.levels.size() <= kMostLevels, [&] {
        return options.model + ": levels: expected at most " + std::to_string(kMostLevels) + ", found " +
               std::to_string(model.summary.levels.size());
    });
    if (!refinementsResolve(model) || model.summary.levels.size() > kMostLevels) {
        leaveOut(verification, {rest.begin() + 1, rest.end()}, "the structure is broken");
        return verification;
    }
    verification.checks.push_back(checkNesting(model));
    verification.checks.push_back(checkMonotoneError(model));
    const std::uint64_t held = factsBytes(file->pages()).count;
    const Bytes pages{std::max(kLeastPages.count, options.memory.count - std::min(options.memory.count, held))};
    verification.checks.push_back(checkCracks(*file, model, options.cuts, options.seed, pages, progress));
    if (options.source.empty()) return verification;
    const auto mesh =
        read::openMeshSources(options.source, gibibytes(64), {}, read::Textures::Bake, options.sourceRoot);
    progress.stage("read the source", "triangles", mesh->summary().faceCount);
    const TriangleSoup soup = readSoup(*mesh, model.summary.grid, progress);
    verification.checks.push_back(checkErrorBound(loadModel(*file, progress), soup, options.seed, progress));
    return verification;
}

} // namespace gnomon::verify

#include "preprocess/make/named_model.h"

#include "core/check.h"
#include "core/error.h"
#include "preprocess/make/planes.h"
#include "preprocess/make/plant.h"
#include "preprocess/make/statue.h"

#include <array>

namespace gnomon::make {

namespace {

struct Kind {
    const char* name;
    std::uint64_t minTriangles;
    std::uint64_t defaultTriangles;
    std::unique_ptr<MadeModel> (*make)(std::uint64_t triangles, std::uint64_t seed);
};

template <class Model>
std::unique_ptr<MadeModel> make(std::uint64_t triangles, std::uint64_t seed) {
    return std::make_unique<Model>(triangles, seed);
}

constexpr std::array<Kind, 3> kKinds{{
    {"statue", Statue::kMinTriangles, 1'000'000, make<Statue>},
    {"plant", Plant::kMinTriangles, 1'000'000, make<Plant>},
    {"planes", Planes::kMinTriangles, 275'500, make<Planes>}, // about 18,000 triangles per aeroplane
}};

const Kind& kindOf(const std::string& name) {
    for (const Kind& kind : kKinds)
        if (name == kind.name) return kind;
    throw Error("make", "unknown kind of model " + name);
}

} // namespace

std::vector<std::string> modelNames() {
    std::vector<std::string> names;
    names.reserve(kKinds.size());
    for (const Kind& kind : kKinds)
        names.emplace_back(kind.name);
    return names;
}

std::uint64_t defaultTriangles(const std::string& kind) {
    return kindOf(kind).defaultTriangles;
}

std::unique_ptr<MadeModel> makeNamedModel(const std::string& kind, std::uint64_t triangles, std::uint64_t seed) {
    const Kind& found = kindOf(kind);
    if (triangles < found.minTriangles)
        throw Error(
            "make " + kind,
            "too few triangles",
            "at least " + std::to_string(found.minTriangles),
            std::to_string(triangles));
    return found.make(triangles, seed);
}

} // namespace gnomon::make

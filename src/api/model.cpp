#include "api/gnomon.h"
#include "api/plain_errors.h"
#include "core/formatted.h"
#include "core/process/floating_point.h"
#include "core/units.h"
#include "hierarchy/model_text.h"
#include "hierarchy/octahedral.h"
#include "preprocess/exporter/export.h"
#include "settings/contradictions.h"
#include "settings/output.h"
#include "settings/plan_json.h"
#include "settings/resolve.h"
#include "task/finished_picture.h"
#include "task/session.h"
#include "telemetry/json_text.h"

#include <optional>
#include <utility>

namespace gnomon::api {

namespace {

/// Converts `options` to settings. The memory and the backend come from the settings of the open model.
settings::Settings askedFor(const Options& options, const settings::Settings& ofModel) {
    for (const char* name : {"memory", "gpu-memory", "backend", "shaders"})
        if (options.contains(name)) throw Error(name, "this option cannot be set for a view of an open model");
    settings::Settings result = settings::settingsOf(options);
    settings::requireSound(result);
    settings::readCamera(result);
    result.memory = ofModel.memory;
    result.backend = ofModel.backend;
    return result;
}

settings::Settings settingsFor(std::uint64_t memory) {
    requireUsualFloatingPoint();
    settings::Settings result;
    result.memory = {memory};
    result.backend = settings::Backend::Software;
    return result;
}

Mesh meshOf(const exporter::UniformCut& cut, const hierarchy::Grid& grid) {
    Mesh mesh;
    mesh.error = cut.error;
    const std::vector<hierarchy::Vertex>& vertices = cut.mesh.vertices;
    mesh.positions.reserve(3 * vertices.size());
    mesh.normals.reserve(3 * vertices.size());
    mesh.colors.reserve(4 * vertices.size());
    for (const hierarchy::Vertex& vertex : vertices) {
        const glm::dvec3 position = grid.world(vertex.position);
        mesh.positions.insert(mesh.positions.end(), {position.x, position.y, position.z});
        const glm::vec3 normal =
            vertex.normal == hierarchy::kNoNormal ? glm::vec3(0) : glm::vec3(hierarchy::unpackNormal(vertex.normal));
        mesh.normals.insert(mesh.normals.end(), {normal.x, normal.y, normal.z});
        for (unsigned channel = 0; channel < 4; ++channel)
            mesh.colors.push_back(static_cast<std::uint8_t>(vertex.color >> (8 * channel)));
    }
    mesh.triangles.reserve(3 * cut.mesh.triangles.size());
    for (const auto& triangle : cut.mesh.triangles)
        mesh.triangles.insert(mesh.triangles.end(), triangle.begin(), triangle.end());
    return mesh;
}

Mesh uniformMesh(const hierarchy::ModelFile& file, const exporter::ExportLimit& limit) {
    NoProgress progress;
    exporter::UniformCut cut = exporter::uniformCut(file, limit, progress);
    exporter::weld(cut.mesh);
    return meshOf(cut, file.summary().grid);
}

} // namespace

struct Model::State {
    settings::Settings settings;
    std::vector<std::string> damage;
    task::Session session;

    State(const std::string& path, std::uint64_t memory)
        : settings(settingsFor(memory)),
          session(path, settings, [this](const std::string& line) { damage.push_back(line); }) {}

    /// Returns the view and the quality that `options` request.
    std::pair<plan::View, plan::Quality> viewOf(const Options& options) const {
        const settings::Settings asked = askedFor(options, settings);
        return {settings::viewOf(asked, session.model()), settings::qualityOf(asked)};
    }
};

Model::Model(const std::string& path, std::uint64_t memory) : state_(std::make_unique<State>(path, memory)) {}

Model::~Model() = default;
Model::Model(Model&&) noexcept = default;
Model& Model::operator=(Model&&) noexcept = default;

std::string Model::info() const {
    return hierarchy::modelJson(state_->session.model());
}

Mesh Model::cutByError(double error) const {
    if (!(error >= 0)) throw Error("error", "invalid length", "a number of at least 0", formatted("%g", error));
    return uniformMesh(state_->session.model(), {std::nullopt, error});
}

Mesh Model::cutByTriangles(std::uint64_t maxTriangles) const {
    return uniformMesh(state_->session.model(), {maxTriangles, std::nullopt});
}

Mesh Model::cutForView(const Options& options) const {
    return withPlainErrors([&] {
        auto [view, quality] = state_->viewOf(options);
        quality.shadows = plan::ShadowMode::Off; // the cut contains no casters
        frame::Renderer& renderer = state_->session.renderer();
        const frame::PreparedFrame frame = renderer.prepare(view, quality);
        const hierarchy::Grid& grid = state_->session.model().summary().grid;
        const hierarchy::ResidentPages pages = renderer.residency().resident();
        exporter::UniformCut cut;
        for (const lod::ClusterRange& range : frame.cut.lists.image.ranges)
            for (std::uint32_t c = 0; c < range.clusterCount; ++c) {
                const hierarchy::Page& page = *pages[range.page];
                exporter::addCluster(page, {}, page.clusters[range.firstCluster + c], grid.snapError(), cut);
            }
        return meshOf(cut, grid);
    });
}

std::string Model::plan(const Options& options) const {
    return withPlainErrors([&] {
        const auto [view, quality] = state_->viewOf(options);
        const settings::BackendChoice backend = task::backendFor(state_->settings, settings::DrawingCommand::Render);
        return telemetry::jsonText(settings::planJson(state_->session.renderer().plan(view, quality), backend), 1);
    });
}

Picture Model::render(const Options& options, int samples) const {
    if (samples < 1 || samples > settings::kMaxSamples)
        throw Error(
            "samples",
            "invalid number of frames",
            "1 to " + std::to_string(settings::kMaxSamples),
            std::to_string(samples));
    return withPlainErrors([&] {
        const auto [view, quality] = state_->viewOf(options);
        NoProgress progress;
        const task::FinishedPicture drawn = task::drawFinished(state_->session, {view, quality, {}, samples}, progress);
        Picture picture{drawn.picture.width, drawn.picture.height, {}};
        picture.pixels.reserve(4 * drawn.picture.pixels.size());
        for (std::size_t i = 0; i < drawn.picture.pixels.size(); ++i) {
            const render::Rgb& color = drawn.picture.pixels[i];
            const std::uint8_t alpha = drawn.coverage ? drawn.coverage->pixels[i] : std::uint8_t{255};
            picture.pixels.insert(picture.pixels.end(), {color[0], color[1], color[2], alpha});
        }
        return picture;
    });
}

const std::vector<std::string>& Model::damage() const {
    return state_->damage;
}

} // namespace gnomon::api

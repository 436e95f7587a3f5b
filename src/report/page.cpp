#include "report/page.h"

#include "report/accuracy_cost.h"
#include "report/page_assets.h"
#include "report/self_contained.h"
#include "report/sentences.h"

#include <algorithm>
#include <cctype>

namespace gnomon::report {

namespace {

nlohmann::json runData(const RunSummary& run) {
    nlohmann::json errors = nlohmann::json::object();
    for (const auto& [kind, value] : run.errors)
        errors[std::string(key(kind))] = value;
    const StageTimes& s = run.stages;
    return {
        {"name", run.name},
        {"options", run.options},
        {"settings", run.settings},
        {"scheme", run.scheme},
        {"shadow_maps", run.shadowMaps},
        {"p50", run.p50Ms},
        {"p95", run.p95Ms},
        {"p99", run.p99Ms},
        {"noise", run.noise ? nlohmann::json(*run.noise) : nlohmann::json()},
        {"stages",
         {{"plan", s.plan},
          {"select", s.select},
          {"cull", s.cull},
          {"stream", s.stream},
          {"shadow", s.shadow},
          {"image", s.image}}},
        {"image_triangles", run.imageTriangles},
        {"shadow_triangles", run.shadowTriangles},
        {"errors", errors},
        {"crawl", run.crawl < 0 ? nlohmann::json() : nlohmann::json(run.crawl)},
        {"storage_factor", run.storageFactor},
        {"promise_kept", run.isBoundKept},
        {"frames", run.frameMs}};
}

/// Quotes `word` for a shell if necessary.
std::string shellWord(const std::string& word) {
    const auto isPlain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' || c == '-';
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), isPlain)) return word;
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

/// Returns the command line of the recommended run, or null if there is none.
nlohmann::json recommendation(const Report& report) {
    const ErrorKind kind = comparedError(report.runs);
    const auto run = recommendedRun(report.runs, kind);
    if (!run) return {};
    const auto model = report.context.find("model");
    const std::string& options = report.runs[*run].options;
    return {
        {"run", *run},
        {"error", key(kind)},
        {"times", kWorthwhileTimes},
        {"command",
         "gnomon render " + shellWord(model == report.context.end() ? "MODEL" : model->second) + " -o picture.png" +
             (options.empty() ? "" : " ") + options}};
}

} // namespace

nlohmann::json pageData(const Report& report) {
    nlohmann::json data = {
        {"model", report.model},
        {"context", report.context},
        {"csv", report.csvFile},
        {"json", report.jsonFile},
        {"sentences", sentences(report.runs)},
        {"runs", nlohmann::json::array()},
        {"errors", nlohmann::json::array()},
        {"recommended", recommendation(report)},
        {"unknown_noise", kUnknownNoise},
        {"leading_error", key(leadingError(report.runs))},
        {"fronts", nlohmann::json::object()},
        {"pictures", nlohmann::json::array()},
        {"storage", nlohmann::json::array()}};
    for (const RunSummary& run : report.runs)
        data["runs"].push_back(runData(run));
    for (const ErrorKind kind : kErrorKinds) {
        data["errors"].push_back({{"key", key(kind)}, {"label", label(kind)}});
        data["fronts"][std::string(key(kind))] = paretoFront(report.runs, kind);
    }
    const Correlation bound = correlation(report.runs, ErrorKind::AliasingBound, ErrorKind::WrongShadow);
    data["correlation"] = {{"rank", bound.rank}, {"runs", bound.runs}, {"disobedient", bound.outliers}};
    for (const StoragePoint& point : report.storage)
        data["storage"].push_back({{"scheme", point.scheme}, {"maps", point.maps}, {"S", point.storageFactor}});
    for (const Picture& picture : report.pictures)
        data["pictures"].push_back(
            {{"run", picture.run}, {"kind", picture.kind}, {"src", "data:image/png;base64," + base64(picture.png)}});
    return data;
}

std::string page(const Report& report) {
    std::string text(kPageHtml);
    substitute(text, "/*CSS*/", kPageCss);
    substitute(text, "/*CHART*/", kChartJs);
    substitute(text, "/*PICTURES*/", kPicturesJs);
    substitute(text, "/*JS*/", kPageJs);
    substitute(text, "/*DATA*/", scriptSafe(pageData(report))); // last, because its strings can contain the other marks
    return text;
}

} // namespace gnomon::report

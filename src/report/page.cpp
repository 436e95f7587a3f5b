#include "report/page.h"

#include "report/accuracy_cost.h"
#include "report/page_assets.h"
#include "report/recommendation.h"
#include "report/self_contained.h"
#include "report/sentences.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <set>

namespace gnomon::report {

namespace {

/// The order of the errors on the page. The plots offer the first three.
constexpr std::array kShownErrors{
    ErrorKind::WrongPixels,
    ErrorKind::AliasingBound,
    ErrorKind::ShadowEdge,
    ErrorKind::MeasuredAliasing,
    ErrorKind::WrongShadow,
    ErrorKind::ImageDifference};

nlohmann::json rangeData(const Range& range) {
    return {range.low, range.high};
}

nlohmann::json stagesData(const StageTimes& s) {
    return {
        {"plan", s.plan},
        {"select", s.select},
        {"cull", s.cull},
        {"stream", s.stream},
        {"shadow", s.shadow},
        {"image", s.image}};
}

/// Returns the range of the repetitions' medians per stage, or null for a single repetition.
nlohmann::json stageRanges(const RunSummary& run) {
    if (!run.noise) return {};
    nlohmann::json ranges = stagesData(run.minStages);
    const nlohmann::json high = stagesData(run.maxStages);
    for (auto& [stage, value] : ranges.items())
        value = {value, high[stage]};
    return ranges;
}

nlohmann::json runData(const RunSummary& run) {
    nlohmann::json errors = nlohmann::json::object();
    for (const auto& [kind, value] : run.errors)
        errors[std::string(key(kind))] = value;
    nlohmann::json errorRanges = nlohmann::json::object();
    for (const auto& [kind, range] : run.errorRanges)
        errorRanges[std::string(key(kind))] = rangeData(range);
    nlohmann::json frameRanges = nlohmann::json::array();
    for (const Range& range : run.frameRanges)
        frameRanges.push_back(rangeData(range));
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
        {"stages", stagesData(run.stages)},
        {"stage_ranges", stageRanges(run)},
        {"image_triangles", run.imageTriangles},
        {"shadow_triangles", run.shadowTriangles},
        {"errors", errors},
        {"error_ranges", errorRanges},
        {"crawl", run.crawl < 0 ? nlohmann::json() : nlohmann::json(run.crawl)},
        {"storage_factor", run.storageFactor},
        {"bound_kept", run.isBoundKept},
        {"frames", run.frameMs},
        {"frame_ranges", frameRanges}};
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

/// Returns the recommended run with its command line and the reason, or only the reason if there is no such run.
nlohmann::json recommendation(const Report& report) {
    const auto run = recommend(report.runs);
    if (!run) return {{"reason", reasonForNone(report.runs)}};
    const auto model = report.context.find("model");
    const std::string& options = report.runs[*run].options;
    return {
        {"run", *run},
        {"reason", reasonFor(*run, report.runs)},
        {"command",
         "gnomon render " + shellWord(model == report.context.end() ? "MODEL" : model->second) + " -o picture.png" +
             (options.empty() ? "" : " ") + options}};
}

/// Returns the recommended run as a step function of a limit: pairs of a limit in `limits` and the run that is
/// recommended from this limit on.
nlohmann::json recommendedSteps(
    const Report& report, const std::set<double>& limits, const std::function<Request(double limit)>& requestOf) {
    nlohmann::json steps = nlohmann::json::array();
    for (const double limit : limits) {
        const auto run = recommend(report.runs, requestOf(limit));
        if (run && (steps.empty() || steps.back()[1] != *run)) steps.push_back({limit, *run});
    }
    return steps;
}

/// Returns `report` with the wrong pixels of exact shadows that were not compared with a ground truth.
Report withKnownAccuracy(Report report) {
    for (RunSummary& run : report.runs)
        if (const auto wrong = wrongPixels(run)) run.errors[ErrorKind::WrongPixels] = *wrong;
    return report;
}

} // namespace

nlohmann::json pageData(const Report& report) {
    const Report known = withKnownAccuracy(report);
    std::set<double> times;
    std::set<double> shares;
    for (const RunSummary& run : known.runs) {
        times.insert(timeToExpectMs(run));
        if (const auto wrong = wrongPixels(run)) shares.insert(*wrong);
    }
    nlohmann::json data = {
        {"model", known.model},
        {"context", known.context},
        {"csv", known.csvFile},
        {"json", known.jsonFile},
        {"sentences", sentences(known.runs)},
        {"runs", nlohmann::json::array()},
        {"errors", nlohmann::json::array()},
        {"recommended", recommendation(known)},
        {"budget_steps",
         recommendedSteps(
             known,
             times,
             [](double ms) {
                 return Request{std::nullopt, ms};
             })},
        {"bound_steps",
         recommendedSteps(
             known,
             shares,
             [](double share) {
                 return Request{share, std::nullopt};
             })},
        {"unknown_noise", kUnknownNoise},
        {"leading_error", key(leadingError(known.runs))},
        {"fronts", nlohmann::json::object()},
        {"pictures", nlohmann::json::array()},
        {"storage", nlohmann::json::array()}};
    for (const RunSummary& run : known.runs)
        data["runs"].push_back(runData(run));
    for (const ErrorKind kind : kShownErrors) {
        data["errors"].push_back({{"key", key(kind)}, {"label", label(kind)}});
        data["fronts"][std::string(key(kind))] = paretoFront(known.runs, kind);
    }
    const Correlation bound = correlation(known.runs, ErrorKind::AliasingBound, ErrorKind::WrongPixels);
    data["correlation"] = {{"rank", bound.rank}, {"runs", bound.runs}, {"outliers", bound.outliers}};
    for (const StoragePoint& point : known.storage)
        data["storage"].push_back({{"scheme", point.scheme}, {"maps", point.maps}, {"S", point.storageFactor}});
    for (const Picture& picture : known.pictures)
        data["pictures"].push_back(
            {{"run", picture.run}, {"kind", picture.kind}, {"src", "data:image/png;base64," + base64(picture.png)}});
    return data;
}

std::string page(const Report& report) {
    std::string text(kPageHtml);
    substitute(text, "/*CSS*/", kPageCss);
    substitute(text, "/*PLOT*/", kPlotJs);
    substitute(text, "/*PICTURES*/", kPicturesJs);
    substitute(text, "/*JS*/", kPageJs);
    substitute(text, "/*DATA*/", scriptSafe(pageData(report))); // last, because its strings can contain the other marks
    return text;
}

} // namespace gnomon::report

#include "report/sun_page.h"

#include "report/page_assets.h"
#include "report/self_contained.h"

namespace gnomon::report {

std::vector<std::uint8_t> litRuns(const std::vector<std::uint8_t>& isLit) {
    std::vector<std::uint8_t> runs;
    bool isOfLit = false;
    for (std::size_t begin = 0; begin < isLit.size(); isOfLit = !isOfLit) {
        std::size_t end = begin;
        while (end < isLit.size() && (isLit[end] != 0) == isOfLit)
            ++end;
        constexpr std::size_t kMore = 128;
        std::size_t length = end - begin;
        for (; length >= kMore; length /= kMore)
            runs.push_back(static_cast<std::uint8_t>(kMore + length % kMore));
        runs.push_back(static_cast<std::uint8_t>(length));
        begin = end;
    }
    return runs;
}

std::string sunPage(const SunPage& page) {
    nlohmann::json data = {
        {"about", page.about},
        {"errors", page.errors},
        {"width", page.width},
        {"height", page.height},
        {"picture", "data:image/png;base64," + base64(page.picture)},
        {"colors", page.colors},
        {"figures", nlohmann::json::array()},
        {"steps", nlohmann::json::array()}};
    for (const SunPage::Figure& figure : page.figures)
        data["figures"].push_back({{"place", figure.place}, {"text", figure.text}});
    for (const SunPage::Step& step : page.steps)
        data["steps"].push_back({{"time", step.time}, {"lit", base64(step.lit)}});
    std::string text(kSunPageHtml);
    substitute(text, "/*CSS*/", kPageCss);
    substitute(text, "/*DATA*/", scriptSafe(data)); // last, because its strings can contain the other marks
    return text;
}

} // namespace gnomon::report

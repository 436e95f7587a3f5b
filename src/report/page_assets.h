// The parts of the report's page, embedded at build time from src/report/page.
#pragma once

#include <string_view>

namespace gnomon::report {

extern const std::string_view kPageHtml;
extern const std::string_view kSunPageHtml;
extern const std::string_view kPageCss;
extern const std::string_view kPicturesJs;
extern const std::string_view kPageJs;
extern const std::string_view kPlotJs;

} // namespace gnomon::report

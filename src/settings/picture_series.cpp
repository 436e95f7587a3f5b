#include "settings/picture_series.h"

#include "settings/resolve.h"
#include "settings/usage_error.h"

namespace gnomon::settings {

void requireSound(const PictureSeries& series, const Settings& settings, bool isNumbered, bool hasOverlay) {
    const bool isStream = series.output == "-";
    const bool isTransparent = settings.quality.look.background.kind == plan::Background::Kind::Transparent;
    if (!series.path.empty() && series.turntable > 0) throw UsageError{"--path and --turntable contradict each other"};
    if (series.path.empty() && series.frames)
        throw UsageError{"--frames is of a path: --path FILE.json --frames N, or --turntable N"};
    if (!series.path.empty() && isPosed(settings))
        throw UsageError{"--path and --camera, --eye, --target, --view, --fov-y contradict each other"};
    if (isStream && isTransparent)
        throw UsageError{"--background transparent and -o - contradict each other: YUV4MPEG2 has no alpha"};
    if (!isStream && !isNumbered)
        refuse("--output", series.output, "- or a name with a number in it, such as frame%04d.png");
    requireLegendShown(settings, hasOverlay);
}

void requireLegendShown(const Settings& settings, bool hasOverlay) {
    if (hasOverlay && settings.quality.look.background.kind == plan::Background::Kind::Transparent)
        throw UsageError{
            "--background transparent contradicts --overlay and --color-by: their legend lies on the background"};
}

} // namespace gnomon::settings

// Determines the up axis of a model, the reason for it, and the unit of the model.
#pragma once

#include "hierarchy/coarse_cut.h"
#include "hierarchy/main_part.h"
#include "hierarchy/model_writer.h"
#include "hierarchy/page_codec.h"
#include "hierarchy/up_guess.h"
#include "preprocess/pipeline/build_options.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::pipeline {

/// The up axis of a model. It is either given, or a guess from the shape of the model's coarse pages.
class UprightModel {
public:
    UprightModel(
        const BuildOptions& options,
        const hierarchy::ModelSummary& summary,
        const std::vector<std::span<const hierarchy::PageInfo>>& pages)
        : options_(options),
          error_(options.up ? 0 : hierarchy::upError(pages, glm::length(hierarchy::mainPartOf(summary).extent()))),
          survey_(summary.grid, hierarchy::mainPartOf(summary)) {}

    /// Returns true if the guess of the up axis needs the triangles of `page`.
    bool isSeen(const hierarchy::PageInfo& page) const { return !options_.up && hierarchy::isDrawnOf(page, error_); }

    void see(const hierarchy::EncodedPage& page) {
        survey_.add(hierarchy::decodePageBytes(page.bytes, page.info), error_);
    }

    /// Stores the up axis, its reason and the confidence of the guess in `summary`.
    void tell(hierarchy::ModelSummary& summary) const {
        summary.unit = options_.unit;
        const hierarchy::UpGuess up =
            options_.up ? hierarchy::UpGuess{*options_.up, options_.upBecause, hierarchy::UpConfidence::Told}
                        : survey_.guess(options_.upVotes);
        summary.up = up.up;
        summary.options["up"] = up.because;
        summary.options["up_confidence"] = wordOf(hierarchy::kUpConfidences, up.confidence);
    }

private:
    const BuildOptions& options_;
    double error_;
    hierarchy::UpSurvey survey_;
};

} // namespace gnomon::pipeline

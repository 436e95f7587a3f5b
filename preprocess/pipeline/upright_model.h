// What a build says of its model's world: which way is up, why, and how long the unit is.
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

/// What was asked for, else what the shape of the model's coarse pages lets guess.
class UprightModel {
public:
    UprightModel(
        const BuildOptions& options,
        const hierarchy::ModelSummary& summary,
        const std::vector<std::span<const hierarchy::PageInfo>>& pages)
        : options_(options),
          error_(options.up ? 0 : hierarchy::coarseError(pages, glm::length(hierarchy::mainPartOf(summary).extent()))),
          survey_(summary.grid, hierarchy::mainPartOf(summary)) {}

    /// Whether it has to see the page.
    bool isSeen(const hierarchy::PageInfo& page) const { return !options_.up && hierarchy::isDrawnOf(page, error_); }

    void see(const hierarchy::EncodedPage& page) {
        survey_.add(hierarchy::decodePageBytes(page.bytes, page.info), error_);
    }

    /// Enters it into `summary`, with the reason unless nobody said a word and it is y: why up is what it is.
    std::string tell(hierarchy::ModelSummary& summary) const {
        summary.unit = options_.unit;
        if (options_.up) {
            summary.up = *options_.up;
            summary.options["up"] = options_.upBecause;
            return options_.upBecause;
        }
        const hierarchy::UpGuess guess = survey_.guess();
        std::string because = (guess.isSure ? "guessed: " : "") + guess.because;
        summary.up = guess.up;
        if (!(guess.up == hierarchy::UpAxis())) summary.options["up"] = because;
        return because;
    }

private:
    const BuildOptions& options_;
    double error_;
    hierarchy::UpSurvey survey_;
};

} // namespace gnomon::pipeline

// A tiny model in memory with its page table, random views of it, and random ancestor-complete residencies.
#pragma once

#include "core/random.h"
#include "lod/cut.h"
#include "tests/support/tiny_model.h"

#include <vector>

namespace gnomon::tests {

/// A model in memory with the lookups that a cut needs.
struct ModelInMemory {
    explicit ModelInMemory(const TinyModelOptions& options);

    TinyModel model;
    std::vector<hierarchy::PageInfo> table;
    std::vector<const hierarchy::Page*> all; // all pages, as if resident
    lod::PageTrees trees;
    Box bounds; // in local space

    std::size_t rootCount() const;
};

/// Returns a rolling height field of about a thousand small pages, made once.
const ModelInMemory& sharedModel();

/// Returns the error that a cut uses for a group or a refinement: the larger of both errors.
template <class Of>
double largerError(const Of& of) {
    return of.attributeError > of.error ? of.attributeError : of.error;
}

/// Returns a view from inside, above or next to the model.
lod::DetailView randomView(Random& random, const Box& bounds);

/// Returns one to four partitions with random slices, texels and lights.
std::vector<lod::CasterDetail> randomCasters(Random& random, const lod::DetailView& view);

/// Returns a random set of pages that contains all roots and is ancestor-complete.
std::vector<const hierarchy::Page*> randomResidency(Random& random, const ModelInMemory& model);

} // namespace gnomon::tests

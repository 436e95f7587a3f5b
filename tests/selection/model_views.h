// A tiny model in memory with its page table, random views of it and random residencies that are closed upwards.
#pragma once

#include "core/random.h"
#include "hierarchy/tiny_model.h"
#include "selection/cut.h"

#include <vector>

namespace gnomon::tests {

/// A model whose pages can be looked up as a cut looks them up.
struct ModelInMemory {
    explicit ModelInMemory(const TinyModelOptions& options);

    TinyModel model;
    std::vector<hierarchy::PageInfo> table;
    std::vector<const hierarchy::Page*> all; // every page resident
    selection::PageTrees trees;
    Box bounds; // local space

    std::size_t rootCount() const;
};

/// A rolling height field of about a thousand small pages, made once.
const ModelInMemory& sharedModel();

/// The error that a cut must obey, of a group or a refinement: the larger of both.
template <class Of>
double largerError(const Of& of) {
    return of.attributeError > of.error ? of.attributeError : of.error;
}

/// A view from somewhere in, above or beside the model.
selection::DetailView randomView(Random& random, const Box& bounds);

/// One to four partitions with random slices, texels and lights.
std::vector<selection::CasterDetail> randomCasters(Random& random, const selection::DetailView& view);

/// Some of the pages, the roots always, closed upwards.
std::vector<const hierarchy::Page*> randomResidency(Random& random, const ModelInMemory& model);

} // namespace gnomon::tests

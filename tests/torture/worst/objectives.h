// What is searched for: how near a case comes to breaking what is promised.
#pragma once

#include "genes.h"

#include <string>
#include <vector>

namespace gnomon::torture {

/// What a case comes to.
struct Score {
    double value = 0;       // the larger the worse
    std::string where = {}; // the case in words, where it was asked for
};

enum class Words : bool { No, Yes };

/// A measure over cases that are drawn from genes. Pure.
struct Objective {
    const char* name = "";
    const char* meaning = ""; // of a value
    std::size_t genes = 0;
    double bar = 1;             // a find is above it
    std::uint64_t slowness = 1; // how many steps of the others one of these stands for
    Score (*score)(Genes genes, Words words) = nullptr;
};

/// Of shadow maps and plans: no geometry.
std::vector<Objective> viewObjectives();

/// Of meshes that are simplified or built.
std::vector<Objective> meshObjectives();

} // namespace gnomon::torture

// The closed forms of src/shadow, each beside its twin of 200 bits and with inputs drawn from its whole domain.
#pragma once

#include "core/random.h"
#include "tests/theory/real.h"

#include <vector>

namespace gnomon::theory {

using Doubles = std::vector<double>;
using Reals = std::vector<Real>;

/// A closed form with all its outputs; both take the same inputs, the view first: near, far, theta, aspect.
struct ClosedForm {
    const char* name;
    std::vector<const char*> outputs;
    Doubles (*draw)(Random&);
    Doubles (*ours)(const Doubles&);
    Reals (*exact)(const Reals&);
    std::size_t wholeFrom = 64; // inputs from here on are whole numbers, which nothing rounds
};

const std::vector<ClosedForm>& closedFormsWithTwins();

} // namespace gnomon::theory

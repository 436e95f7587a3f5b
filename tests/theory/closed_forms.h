// The closed forms of src/shadow, each with its 200-bit version and inputs from its whole domain.
#pragma once

#include "core/random.h"
#include "tests/support/real.h"

#include <vector>

namespace gnomon::theory {

using Doubles = std::vector<double>;
using Reals = std::vector<Real>;

/// A closed form with all its outputs. Both versions take the same inputs, which begin with the view: near, far, theta,
/// aspect.
struct ClosedForm {
    const char* name;
    std::vector<const char*> outputs;
    Doubles (*draw)(Random&);
    Doubles (*ours)(const Doubles&);
    Reals (*exact)(const Reals&);
    std::size_t wholeFrom = 64; // from this index on, inputs are integers and never rounded
};

const std::vector<ClosedForm>& closedFormsWithTwins();

} // namespace gnomon::theory

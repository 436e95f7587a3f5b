// Opens a model by its path or web address.
#pragma once

#include "hierarchy/source/access.h"
#include "hierarchy/source/source.h"

#include <memory>
#include <string>

namespace gnomon::hierarchy {

/// Returns true if `name` is an http:// or https:// address instead of a path.
bool isAddress(const std::string& name);

/// Opens the file at the path `name`, or the content at the address `name`. Throws Error if that fails.
std::unique_ptr<Source> openSource(const std::string& name, const Access& access = commonAccess());

} // namespace gnomon::hierarchy

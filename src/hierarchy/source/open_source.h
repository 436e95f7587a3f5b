// Opens the bytes of a model by path or web address.
#pragma once

#include "hierarchy/source/access.h"
#include "hierarchy/source/source.h"

#include <memory>
#include <string>

namespace gnomon::hierarchy {

/// Returns true if `name` begins with http:// or https://, so that it is a web address instead of a path.
bool isAddress(const std::string& name);

/// Opens a local file or a web address for reading. Throws Error if that fails.
std::unique_ptr<Source> openSource(const std::string& name, const Access& access = commonAccess());

} // namespace gnomon::hierarchy

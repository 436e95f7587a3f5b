// Opening of a model by path or address.
#pragma once

#include "storage/access.h"
#include "storage/source.h"

#include <memory>
#include <string>

namespace gnomon::storage {

/// Returns true if `name` is an http:// or https:// address and not a path.
bool isAddress(const std::string& name);

/// Opens the file at the path `name`, or the content at the address `name`. Throws Error if that fails.
std::unique_ptr<Source> openSource(const std::string& name, const Access& access = commonAccess());

} // namespace gnomon::storage

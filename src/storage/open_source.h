// Finds out where a model lies by its name.
#pragma once

#include "storage/access.h"
#include "storage/source.h"

#include <memory>
#include <string>

namespace gnomon::storage {

/// Whether `name` is an address, http:// or https://, and not a path.
bool isAddress(const std::string& name);

/// Opens the file at the path `name`, or what the server has at the address `name`. Throws Error.
std::unique_ptr<Source> openSource(const std::string& name, const Access& access = commonAccess());

} // namespace gnomon::storage

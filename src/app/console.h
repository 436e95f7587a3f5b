// Prints messages to stderr, and checks the standard file descriptors.
#pragma once

#include <string>

namespace gnomon::app {

/// Opens /dev/null for each of the descriptors 0 to 2 that is closed. Otherwise a file could get the number of stderr,
/// and messages would go into this file. Reads from and writes to such a descriptor still fail. Must be called first in
/// `main`.
void occupyStandardDescriptors();

/// Prints "gnomon: TEXT" to stderr, in one line and without control characters.
void printMessage(const std::string& text);

/// Prints "gnomon: warning: TEXT" to stderr, in one line and without control characters.
void printWarning(const std::string& text);

/// Flushes stdout and throws Error if output is lost. `kept` is added to the message. It says which results are
/// complete nevertheless, for example "the model o.gnm is complete".
void requirePrinted(const std::string& kept = "");

} // namespace gnomon::app

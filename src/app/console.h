// The three standard descriptors of a command: what is told on stderr, and whether what was printed has arrived.
#pragma once

#include <string>

namespace gnomon::app {

/// Opens those of the descriptors 0 to 2 that are closed on the null device, so that no file gets their number and then
/// what is meant for stderr; reading from and writing to them fails as before. To be called first of all.
void occupyStandardDescriptors();

/// "gnomon: TEXT" on stderr, in one line and without control characters.
void printMessage(const std::string& text);

/// The same for what is no failure: "gnomon: warning: TEXT".
void printWarning(const std::string& text);

/// Throws Error if something that was printed has not reached stdout; `kept` says what is whole all the same, as in
/// "the model o.gnm is complete".
void requirePrinted(const std::string& kept = "");

} // namespace gnomon::app

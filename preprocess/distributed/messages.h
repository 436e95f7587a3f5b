// What letters between the processes of a build say, and how as bytes.
#pragma once

#include "preprocess/pipeline/tasks/process_team.h"

#include <string>
#include <vector>

namespace gnomon::distributed {

/// What a helper says first.
struct Hello {
    std::string host;
    std::uint32_t threads = 1;
    std::string key; // of input and options: all processes must have the same
};

/// What all tasks need.
struct Beginning {
    pipeline::ScratchPlace place; // the leader's; helper i has the i-th part after it
};

struct Assignment {
    pipeline::TaskKind kind = pipeline::TaskKind::BuildNode;
    std::uint32_t task = 0;
    std::vector<std::byte> input;
};

/// What came of an assignment.
struct Outcome {
    std::uint32_t task = 0;
    double seconds = 0;
    std::uint64_t progress = 0;  // since the outcome before
    std::uint64_t bytesRead = 0; // likewise
    std::uint64_t bytesWritten = 0;
    std::vector<std::byte> result;
};

/// What a helper says last.
struct Farewell {
    std::uint64_t peakResidentBytes = 0;
    std::uint64_t tableBytes = 0; // as in ProcessReport
    std::uint64_t bytesSent = 0;
};

std::vector<std::byte> encoded(const Hello& hello);
std::vector<std::byte> encoded(const Beginning& beginning);
std::vector<std::byte> encoded(const Assignment& assignment);
std::vector<std::byte> encoded(const Outcome& outcome);
std::vector<std::byte> encoded(const Farewell& farewell);
std::vector<std::byte> encoded(const std::string& text);

/// What `encoded` made. Throw hierarchy::Damage.
Hello decodedHello(std::span<const std::byte> bytes);
Beginning decodedBeginning(std::span<const std::byte> bytes);
Assignment decodedAssignment(std::span<const std::byte> bytes);
Outcome decodedOutcome(std::span<const std::byte> bytes);
Farewell decodedFarewell(std::span<const std::byte> bytes);
std::string decodedText(std::span<const std::byte> bytes);

} // namespace gnomon::distributed

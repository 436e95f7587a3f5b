// The contents of the messages between the processes of a distributed build, and their encoding as bytes.
#pragma once

#include "preprocess/pipeline/tasks/process_team.h"

#include <string>
#include <vector>

namespace gnomon::distributed {

/// The first message that a helper process sends to the leader.
struct Hello {
    std::string host;
    std::uint32_t threads = 1;
    std::string key; // key of the input and the options of this process; all processes must have the same key
};

/// The message with which the leader starts the helper processes.
struct Beginning {
    pipeline::ScratchPlace place; // scratch files of the leader; helper i uses the i-th part after the leader's
};

/// A task that the leader assigns to a helper process, with its input.
struct Assignment {
    pipeline::TaskKind kind = pipeline::TaskKind::BuildNode;
    std::uint32_t task = 0;
    std::vector<std::byte> input;
};

/// The result of a task that a helper process has run.
struct Outcome {
    std::uint32_t task = 0;
    double seconds = 0;
    std::uint64_t progress = 0;  // units of work since the previous result
    std::uint64_t bytesRead = 0; // bytes that the helper read since the previous result
    std::uint64_t bytesWritten = 0;
    std::vector<std::byte> result;
};

/// The last message that a helper process sends to the leader.
struct Farewell {
    std::uint64_t peakResidentBytes = 0;
    std::uint64_t tableBytes = 0; // peak size of the per-vertex tables, as in ProcessReport
    std::uint64_t bytesSent = 0;
};

/// Encodes the content of a message as bytes.
std::vector<std::byte> encoded(const Hello& hello);
std::vector<std::byte> encoded(const Beginning& beginning);
std::vector<std::byte> encoded(const Assignment& assignment);
std::vector<std::byte> encoded(const Outcome& outcome);
std::vector<std::byte> encoded(const Farewell& farewell);
std::vector<std::byte> encoded(const std::string& text);

/// Decodes the message bytes that `encoded` returned. The functions throw hierarchy::Damage if the bytes are malformed.
Hello decodedHello(std::span<const std::byte> bytes);
Beginning decodedBeginning(std::span<const std::byte> bytes);
Assignment decodedAssignment(std::span<const std::byte> bytes);
Outcome decodedOutcome(std::span<const std::byte> bytes);
Farewell decodedFarewell(std::span<const std::byte> bytes);
std::string decodedText(std::span<const std::byte> bytes);

} // namespace gnomon::distributed

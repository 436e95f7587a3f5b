// What the processes of a task farm say to each other, and how as bytes.
#pragma once

#include "core/process/task_farm.h"

#include <cstdint>
#include <span>
#include <string>

namespace gnomon::mpi {

/// What a process that is led says first.
struct Greeting {
    FarmMember self;
    std::string key; // of what it works on: all must have the same
};

struct Assignment {
    std::uint64_t task = 0;
    TaskBytes input;
};

/// What came of an assignment.
struct Outcome {
    std::uint64_t task = 0;
    double seconds = 0;
    std::uint64_t peakResidentBytes = 0;
    std::uint64_t bytesSent = 0; // so far, this message aside
    TaskBytes result;
};

/// What a process says while it works.
struct News {
    std::uint64_t progress = 0; // since the last time
    bool isTold = false;        // `told` is for who hears, be it empty
    TaskBytes told;
};

TaskBytes encoded(const Greeting& greeting);
TaskBytes encoded(const Assignment& assignment);
TaskBytes encoded(const Outcome& outcome);
TaskBytes encoded(const News& news);

/// What `encoded` made. Throw hierarchy::Damage.
Greeting decodedGreeting(std::span<const std::byte> bytes);
Assignment decodedAssignment(std::span<const std::byte> bytes);
Outcome decodedOutcome(std::span<const std::byte> bytes);
News decodedNews(std::span<const std::byte> bytes);

} // namespace gnomon::mpi

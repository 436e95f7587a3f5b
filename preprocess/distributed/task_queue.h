// The tasks of a phase that are still to be handed out.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace gnomon::distributed {

/// Which process has done something for which task before.
using Homes = std::map<std::uint32_t, std::uint32_t>;

/// Each process gets its own first; then, and without `homes`, what comes next of all.
class TaskQueue {
public:
    /// `tasks` in the order in which they are to go.
    TaskQueue(std::vector<std::uint32_t> tasks, const Homes& homes);

    bool isEmpty() const { return left_ == 0; }

    /// The next task for process `rank`; not of an empty queue.
    std::uint32_t takeFor(std::uint32_t rank);

private:
    /// Places in `tasks_` in order, and how many of them were looked at.
    struct Line {
        std::vector<std::size_t> places;
        std::size_t next = 0;
    };

    std::vector<std::uint32_t> tasks_;
    std::vector<bool> isTaken_;
    std::map<std::uint32_t, Line> own_; // by rank
    std::size_t next_ = 0;
    std::size_t left_;
};

} // namespace gnomon::distributed

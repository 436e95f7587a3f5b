#include "preprocess/distributed/task_queue.h"

#include "core/check.h"

#include <utility>

namespace gnomon::distributed {

TaskQueue::TaskQueue(std::vector<std::uint32_t> tasks, const Homes& homes)
    : tasks_(std::move(tasks)), isTaken_(tasks_.size()), left_(tasks_.size()) {
    for (std::size_t place = 0; place < tasks_.size(); ++place)
        if (const auto home = homes.find(tasks_[place]); home != homes.end())
            own_[home->second].places.push_back(place);
}

std::uint32_t TaskQueue::takeFor(std::uint32_t rank) {
    GNOMON_CHECK(!isEmpty());
    Line& own = own_[rank];
    while (own.next < own.places.size() && isTaken_[own.places[own.next]])
        ++own.next;
    std::size_t place = 0;
    if (own.next < own.places.size()) {
        place = own.places[own.next];
    } else {
        while (isTaken_[next_])
            ++next_;
        place = next_;
    }
    isTaken_[place] = true;
    --left_;
    return tasks_[place];
}

} // namespace gnomon::distributed

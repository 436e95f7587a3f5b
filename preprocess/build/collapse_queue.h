// The order in which vertices collapse: a binary heap of (cost, vertex) in which costs may change.
#pragma once

#include "hierarchy/page.h"

#include <utility>
#include <vector>

namespace gnomon::preprocess {

/// Each vertex is in the queue at most once; equal costs leave in the order of the vertices.
class CollapseQueue {
public:
    explicit CollapseQueue(std::size_t vertexCount) : place_(vertexCount, hierarchy::kNone) {}

    bool isEmpty() const { return heap_.empty(); }

    bool holds(std::uint32_t vertex) const { return place_[vertex] != hierarchy::kNone; }

    /// The cost of a vertex that it holds.
    double costOf(std::uint32_t vertex) const { return heap_[place_[vertex]].first; }

    /// The cost of the cheapest.
    double least() const { return heap_.front().first; }

    /// Inserts `vertex` or changes its cost.
    void put(std::uint32_t vertex, double cost) {
        std::uint32_t place = place_[vertex];
        if (place == hierarchy::kNone) {
            place = static_cast<std::uint32_t>(heap_.size());
            heap_.emplace_back(cost, vertex);
            place_[vertex] = place;
        } else {
            heap_[place].first = cost;
        }
        sink(rise(place));
    }

    void remove(std::uint32_t vertex) {
        const std::uint32_t place = place_[vertex];
        if (place == hierarchy::kNone) return;
        place_[vertex] = hierarchy::kNone;
        const Entry last = heap_.back();
        heap_.pop_back();
        if (place == heap_.size()) return;
        heap_[place] = last;
        place_[last.second] = place;
        sink(rise(place));
    }

    /// Removes and returns the cheapest vertex.
    std::uint32_t take() {
        const std::uint32_t vertex = heap_.front().second;
        remove(vertex);
        return vertex;
    }

private:
    using Entry = std::pair<double, std::uint32_t>;

    std::uint32_t rise(std::uint32_t place) {
        const Entry entry = heap_[place];
        while (place > 0) {
            const std::uint32_t parent = (place - 1) / 2;
            if (!(entry < heap_[parent])) break;
            set(place, heap_[parent]);
            place = parent;
        }
        set(place, entry);
        return place;
    }

    void sink(std::uint32_t place) {
        const Entry entry = heap_[place];
        for (;;) {
            std::size_t child = 2 * static_cast<std::size_t>(place) + 1;
            if (child >= heap_.size()) break;
            if (child + 1 < heap_.size() && heap_[child + 1] < heap_[child]) ++child;
            if (!(heap_[child] < entry)) break;
            set(place, heap_[child]);
            place = static_cast<std::uint32_t>(child);
        }
        set(place, entry);
    }

    void set(std::uint32_t place, const Entry& entry) {
        heap_[place] = entry;
        place_[entry.second] = place;
    }

    std::vector<Entry> heap_;
    std::vector<std::uint32_t> place_;
};

} // namespace gnomon::preprocess

// Whose threads the tasks of whom may share, where a phase has fewer tasks left than there are processes.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace gnomon::distributed {

/// A process, as far as its threads are concerned.
struct HostMember {
    std::string host;
    std::size_t threads = 1;
    bool isBusy = false; // it has a task
};

/// For each process how many threads of others on its host it may use besides: those of processes without a task,
/// shared out evenly to those with one.
inline std::vector<std::size_t> lentThreads(const std::vector<HostMember>& members) {
    struct Host {
        std::size_t idle = 0;
        std::size_t busy = 0;
        std::size_t served = 0;
    };

    std::map<std::string, Host> hosts;
    for (const HostMember& member : members) {
        Host& host = hosts[member.host];
        if (member.isBusy)
            ++host.busy;
        else
            host.idle += member.threads;
    }
    std::vector<std::size_t> lent;
    for (const HostMember& member : members) {
        Host& host = hosts[member.host];
        const std::size_t more = member.isBusy && host.served++ < host.idle % host.busy ? 1 : 0;
        lent.push_back(member.isBusy ? host.idle / host.busy + more : 0);
    }
    return lent;
}

} // namespace gnomon::distributed

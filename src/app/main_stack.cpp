#include "app/main_stack.h"

#include <cstddef>
#include <thread>

#include <pthread.h>
#include <sys/resource.h>

namespace gnomon::app {

int onLargeStack(const std::function<int()>& work) {
    constexpr std::size_t kStackBytes = std::size_t{8} << 20U; // the default limit of most systems
    rlimit limit{};
    if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kStackBytes) return work();
    pthread_attr_t attributes{};
    ::pthread_attr_init(&attributes);
    ::pthread_attr_setstacksize(&attributes, kStackBytes);
    ::pthread_setattr_default_np(&attributes);
    ::pthread_attr_destroy(&attributes);
    int code = 1;
    std::thread([&] { code = work(); }).join();
    return code;
}

} // namespace gnomon::app

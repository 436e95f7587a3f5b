#include "core/temporary_name.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <utility>

#include <sched.h>
#include <unistd.h>

namespace gnomon {

namespace {

// The signal handler uses only the following two objects. It can wait for the lock without a deadlock, because a
// thread blocks signals while it holds the lock.
constinit std::atomic_flag isLocked;       // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
constinit TemporaryName* newest = nullptr; // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

/// Locks the list of temporary names. Other threads wait for the lock, and this thread blocks signals meanwhile.
/// `errno` does not change.
class Lock {
public:
    Lock() {
        sigset_t all;
        ::sigfillset(&all);
        ::pthread_sigmask(SIG_SETMASK, &all, &before_);
        while (isLocked.test_and_set(std::memory_order_acquire))
            ::sched_yield();
    }

    ~Lock() {
        const int error = errno;
        isLocked.clear(std::memory_order_release);
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
        errno = error;
    }

    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
    Lock(Lock&&) = delete;
    Lock& operator=(Lock&&) = delete;

private:
    sigset_t before_{};
};

void removeName(const std::string& path) {
    if (::unlink(path.c_str()) != 0 && (errno == EISDIR || errno == EPERM)) ::rmdir(path.c_str());
}

} // namespace

TemporaryName::TemporaryName(std::string path, const std::function<bool()>& make) : path_(std::move(path)) {
    const Lock lock;
    if (make()) enter();
}

TemporaryName::~TemporaryName() {
    const Lock lock;
    if (!isHeld_) return;
    removeName(path_);
    leave();
}

bool TemporaryName::keep(const std::function<bool()>& finish) {
    const Lock lock;
    if (!finish()) return false;
    if (isHeld_) leave();
    return true;
}

void TemporaryName::removeNames() {
    for (const TemporaryName* name = newest; name != nullptr; name = name->older_)
        removeName(name->path_);
}

void TemporaryName::removeAll() {
    const Lock lock;
    removeNames();
}

void TemporaryName::removeAllAndExit(int status) {
    const Lock lock; // never unlocked, so that no other thread creates a new name
    removeNames();
    ::_exit(status);
}

void TemporaryName::enter() {
    isHeld_ = true;
    older_ = newest;
    if (older_ != nullptr) older_->newer_ = this;
    newest = this;
}

void TemporaryName::leave() {
    isHeld_ = false;
    if (older_ != nullptr) older_->newer_ = newer_;
    (newer_ != nullptr ? newer_->older_ : newest) = older_;
}

} // namespace gnomon

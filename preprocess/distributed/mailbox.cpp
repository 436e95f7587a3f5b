#include "preprocess/distributed/mailbox.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <thread>

#include <mpi.h>

namespace gnomon::distributed {

struct Mailbox::Sending {
    std::vector<std::byte> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
};

// A failed MPI call ends the whole job, because the default error handler of MPI is active.
Mailbox::Mailbox(int* argc, char*** argv) {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
    int rank = 0;
    int count = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    rank_ = static_cast<std::uint32_t>(rank);
    count_ = static_cast<std::uint32_t>(count);
    std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
    int length = 0;
    MPI_Get_processor_name(name.data(), &length);
    host_.assign(name.data(), static_cast<std::size_t>(length));
}

Mailbox::~Mailbox() {
    MPI_Finalize();
}

void Mailbox::send(std::uint32_t to, Subject subject, std::vector<std::byte> bytes) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw Error("MPI", "a message between processes is too large", "at most 2 GiB", std::to_string(bytes.size()));
    hasSentAll(); // frees the buffers of messages that MPI has sent
    auto sending = std::make_unique<Sending>();
    sending->bytes = std::move(bytes);
    bytesSent_ += sending->bytes.size();
    MPI_Isend(
        sending->bytes.data(),
        static_cast<int>(sending->bytes.size()),
        MPI_BYTE,
        static_cast<int>(to),
        static_cast<int>(subject),
        MPI_COMM_WORLD,
        &sending->request);
    sending_.push_back(std::move(sending));
}

bool Mailbox::hasSentAll() {
    std::erase_if(sending_, [](const std::unique_ptr<Sending>& sending) {
        int isDone = 0;
        MPI_Test(&sending->request, &isDone, MPI_STATUS_IGNORE);
        return isDone != 0;
    });
    return sending_.empty();
}

std::optional<Letter> Mailbox::receive() {
    hasSentAll();
    int isThere = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &isThere, &status);
    if (isThere == 0) return {};
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Letter letter{static_cast<std::uint32_t>(status.MPI_SOURCE), static_cast<Subject>(status.MPI_TAG), {}};
    letter.bytes.resize(static_cast<std::size_t>(size));
    MPI_Recv(letter.bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return letter;
}

void Mailbox::abort() {
    MPI_Abort(MPI_COMM_WORLD, 1);
    std::_Exit(1);
}

void Backoff::wait() {
    constexpr int kMaxMicroseconds = 1000;
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds_));
    microseconds_ = std::min(2 * microseconds_, kMaxMicroseconds);
}

} // namespace gnomon::distributed

#include "mpi/mpi_messages.h"

#include <mpi.h>

#include <deque>
#include <limits>
#include <list>
#include <stdexcept>
#include <thread>

#include "mpi/mpi_calls.h"

namespace raytube {

namespace {

using namespace std::chrono_literals;

constexpr std::size_t most_pending = std::size_t{64} << 20;  // [bytes] under way from one rank
constexpr std::size_t most_received_at_once = 64;            // messages; of others those who send keep them
constexpr auto first_pause = 50us, longest_pause = 1000us;

bool is_over(MPI_Request& request) {
  int over = 0;
  MPI_Test(&request, &over, MPI_STATUS_IGNORE);
  return over != 0;
}

struct Message {
  MPI_Request request = MPI_REQUEST_NULL;
  int tag = 0;
  std::string bytes{};
};

}  // namespace

struct MpiOutbox::Messages {
  MPI_Comm all;
  std::deque<Message> pending{};
  std::size_t bytes = 0;

  // True if none is under way any more.
  bool reap() {
    while (!pending.empty() && is_over(pending.front().request)) {
      bytes -= pending.front().bytes.size();
      pending.pop_front();
    }
    return pending.empty();
  }
};

MpiOutbox::MpiOutbox(int communicator) : messages_(new Messages{MPI_Comm_f2c(communicator)}) {}
MpiOutbox::~MpiOutbox() = default;

void MpiOutbox::send(int tag, std::string bytes) {
  if (bytes.size() > std::numeric_limits<int>::max())
    throw std::runtime_error("a look takes more than 2 GB, which no message holds; split the frequencies");
  std::unique_lock lock(mpi_mutex);
  messages_->reap();
  Message& message = messages_->pending.emplace_back(MPI_REQUEST_NULL, tag, std::move(bytes));
  messages_->bytes += message.bytes.size();
  MPI_Isend(message.bytes.data(), static_cast<int>(message.bytes.size()), MPI_BYTE, 0, tag, messages_->all, &message.request);
  const bool is_too_much = messages_->bytes > most_pending;
  lock.unlock();
  if (is_too_much) flush();
}

void MpiOutbox::flush() {
  wait_until([this] { return messages_->reap(); });
}

struct MpiInbox::Receiver {
  MPI_Comm all;
  Take take;
  std::list<Message> coming{};
  std::jthread thread{};

  void run(const std::stop_token& over) {
    for (std::chrono::microseconds pause = first_pause; !over.stop_requested();) {
      const bool any = take_those_here();
      pause = any ? first_pause : std::min<std::chrono::microseconds>(2 * pause, longest_pause);
      if (!any) std::this_thread::sleep_for(pause);
    }
  }

  bool take_those_here() {
    std::list<Message> here;
    {
      const std::lock_guard lock(mpi_mutex);
      while (coming.size() < most_received_at_once && begin_next()) continue;
      for (auto message = coming.begin(); message != coming.end();) {
        const auto next = std::next(message);
        if (is_over(message->request)) here.splice(here.end(), coming, message);
        message = next;
      }
    }
    for (Message& message : here) take(message.tag, std::move(message.bytes));
    return !here.empty();
  }

  bool begin_next() {
    int found = 0, size = 0;
    MPI_Message handle = MPI_MESSAGE_NULL;
    MPI_Status status;
    MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, all, &found, &handle, &status);
    if (found == 0) return false;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Message& message = coming.emplace_back(MPI_REQUEST_NULL, status.MPI_TAG, std::string(static_cast<std::size_t>(size), '\0'));
    MPI_Imrecv(message.bytes.data(), size, MPI_BYTE, &handle, &message.request);
    return true;
  }
};

MpiInbox::MpiInbox(int communicator, Take take) : receiver_(new Receiver{MPI_Comm_f2c(communicator), std::move(take)}) {
  receiver_->thread = std::jthread([this](const std::stop_token& over) { receiver_->run(over); });
}
MpiInbox::~MpiInbox() = default;

}  // namespace raytube

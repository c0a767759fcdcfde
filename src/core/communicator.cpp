// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/core/communicator.h"

#include <algorithm>
#include <numeric>

#define OMPI_SKIP_MPICXX  // the C interface is all that is used
#include <mpi.h>

namespace furrow {

struct Communicator::Handle {
  MPI_Comm comm;
  int rank, size;
  std::size_t longest_message;

  /// Calls send(first, count) for each part of an array that fits into one message.
  template <class Send>
  void in_parts(std::size_t length, Send&& send) const {
    for (std::size_t first = 0; first < length; first += longest_message)
      send(first, static_cast<int>(std::min(longest_message, length - first)));
  }
};

Communicator::Communicator() : handle_(new Handle{MPI_COMM_NULL, 0, 1, 1}) {}
Communicator::Communicator(const void* mpi_comm, std::size_t longest_message)
    : handle_(new Handle{*static_cast<const MPI_Comm*>(mpi_comm), 0, 1, longest_message}) {
  MPI_Comm_rank(handle_->comm, &handle_->rank);
  MPI_Comm_size(handle_->comm, &handle_->size);
}
Communicator::~Communicator() = default;
Communicator::Communicator(const Communicator& other) : handle_(new Handle(*other.handle_)) {}
Communicator& Communicator::operator=(const Communicator& other) {
  *handle_ = *other.handle_;
  return *this;
}

int Communicator::rank() const { return handle_->rank; }
int Communicator::size() const { return handle_->size; }

int Communicator::on_this_machine() const {
  if (size() == 1) return 1;
  MPI_Comm machine;
  MPI_Comm_split_type(handle_->comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int count = 1;
  MPI_Comm_size(machine, &count);
  MPI_Comm_free(&machine);
  return count;
}

void Communicator::sum(double* values, std::size_t count) const {
  if (size() == 1) return;
  // Reduce and broadcast, not allreduce: replicated bodies must stay bitwise equal, and MPI does
  // not promise that for allreduce.
  handle_->in_parts(count, [&](std::size_t first, int n) {
    double* part = values + first;
    MPI_Reduce(rank() == 0 ? MPI_IN_PLACE : part, part, n, MPI_DOUBLE, MPI_SUM, 0, handle_->comm);
    MPI_Bcast(part, n, MPI_DOUBLE, 0, handle_->comm);
  });
}

double Communicator::sum(double value) const {
  sum(&value, 1);
  return value;
}

double Communicator::max(double value) const {
  if (size() > 1) MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, handle_->comm);
  return value;
}

void Communicator::max(double* values, std::size_t count) const {
  if (size() == 1) return;
  handle_->in_parts(count, [&](std::size_t first, int n) {
    MPI_Allreduce(MPI_IN_PLACE, values + first, n, MPI_DOUBLE, MPI_MAX, handle_->comm);
  });
}

/// Messages between two ranks arrive in the order in which they are sent.
void Communicator::exchange(std::vector<Message>& messages) const {
  std::vector<MPI_Request> requests;
  for (Message& message : messages)
    handle_->in_parts(message.received.size(), [&](std::size_t first, int n) {
      MPI_Irecv(message.received.data() + first, n, MPI_DOUBLE, message.other, 0, handle_->comm,
                &requests.emplace_back());
    });
  for (const Message& message : messages)
    handle_->in_parts(message.sent.size(), [&](std::size_t first, int n) {
      MPI_Isend(message.sent.data() + first, n, MPI_DOUBLE, message.other, 0, handle_->comm,
                &requests.emplace_back());
    });
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

void Communicator::exchange_lengths(std::vector<Message>& messages) const {
  std::vector<Message> lengths;
  for (const Message& message : messages)
    lengths.push_back({message.other, {static_cast<double>(message.sent.size())}, {0.0}});
  exchange(lengths);
  for (std::size_t n = 0; n < messages.size(); ++n)
    messages[n].received.resize(static_cast<std::size_t>(lengths[n].received[0]));
}

std::vector<std::uint64_t> Communicator::lengths_on_ranks(std::size_t mine) const {
  const std::uint64_t length = mine;
  std::vector<std::uint64_t> lengths(static_cast<std::size_t>(size()));
  MPI_Allgather(&length, 1, MPI_UINT64_T, lengths.data(), 1, MPI_UINT64_T, handle_->comm);
  return lengths;
}

std::vector<double> Communicator::gather_to_first(const std::vector<double>& numbers) const {
  if (size() == 1) return numbers;
  const std::vector<std::uint64_t> lengths = lengths_on_ranks(numbers.size());
  if (rank() > 0) {
    handle_->in_parts(numbers.size(), [&](std::size_t first, int n) {
      MPI_Send(numbers.data() + first, n, MPI_DOUBLE, 0, 0, handle_->comm);
    });
    return {};
  }
  std::vector<double> all(std::accumulate(lengths.begin(), lengths.end(), std::size_t(0)));
  double* next = std::copy(numbers.begin(), numbers.end(), all.data());
  for (int r = 1; r < size(); ++r) {
    const std::size_t length = lengths[static_cast<std::size_t>(r)];
    handle_->in_parts(length, [&](std::size_t first, int n) {
      MPI_Recv(next + first, n, MPI_DOUBLE, r, 0, handle_->comm, MPI_STATUS_IGNORE);
    });
    next += length;
  }
  return all;
}

std::vector<double> Communicator::gather(const std::vector<double>& numbers) const {
  std::vector<double> all = gather_to_first(numbers);
  if (size() == 1) return all;
  const std::vector<std::uint64_t> lengths = lengths_on_ranks(numbers.size());
  all.resize(std::accumulate(lengths.begin(), lengths.end(), std::size_t(0)));
  handle_->in_parts(all.size(), [&](std::size_t first, int n) {
    MPI_Bcast(all.data() + first, n, MPI_DOUBLE, 0, handle_->comm);
  });
  return all;
}

bool Communicator::any(bool value) const { return max(value ? 1.0 : 0.0) > 0.0; }

}  // namespace furrow

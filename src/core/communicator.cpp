// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/communicator.h"

#define OMPI_SKIP_MPICXX  // the C interface is all that is used
#include <mpi.h>

namespace furrow {

struct Communicator::Handle {
  MPI_Comm comm;
  int rank, size;
};

Communicator::Communicator() : handle_(new Handle{MPI_COMM_NULL, 0, 1}) {}
Communicator::Communicator(const void* mpi_comm)
    : handle_(new Handle{*static_cast<const MPI_Comm*>(mpi_comm), 0, 1}) {
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
  const int n = static_cast<int>(count);
  MPI_Reduce(rank() == 0 ? MPI_IN_PLACE : values, values, n, MPI_DOUBLE, MPI_SUM, 0, handle_->comm);
  MPI_Bcast(values, n, MPI_DOUBLE, 0, handle_->comm);
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
  if (size() > 1)
    MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(count), MPI_DOUBLE, MPI_MAX,
                  handle_->comm);
}

void Communicator::exchange(std::vector<Message>& messages) const {
  std::vector<MPI_Request> requests;
  for (Message& message : messages)
    if (!message.received.empty())
      MPI_Irecv(message.received.data(), static_cast<int>(message.received.size()), MPI_DOUBLE,
                message.other, 0, handle_->comm, &requests.emplace_back());
  for (const Message& message : messages)
    if (!message.sent.empty())
      MPI_Isend(message.sent.data(), static_cast<int>(message.sent.size()), MPI_DOUBLE,
                message.other, 0, handle_->comm, &requests.emplace_back());
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

std::vector<double> Communicator::gather(const std::vector<double>& numbers) const {
  if (size() == 1) return numbers;
  const int mine = static_cast<int>(numbers.size());
  std::vector<int> counts(static_cast<std::size_t>(size())), starts(counts.size(), 0);
  MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, handle_->comm);
  for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<double> all(static_cast<std::size_t>(starts.back() + counts.back()));
  MPI_Allgatherv(numbers.data(), mine, MPI_DOUBLE, all.data(), counts.data(), starts.data(),
                 MPI_DOUBLE, handle_->comm);
  return all;
}

bool Communicator::any(bool value) const { return max(value ? 1.0 : 0.0) > 0.0; }

}  // namespace furrow

#include "core/communicator.h"

#include <mpi.h>

namespace furrow {

struct Communicator::Handle {
  MPI_Comm comm;
  int rank, size;
};

Communicator::Communicator() : handle_(new Handle{MPI_COMM_NULL, 0, 1}) {}
Communicator::Communicator(const void* mpi_comm) : handle_(new Handle{*static_cast<const MPI_Comm*>(mpi_comm), 0, 1}) {
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

void Communicator::sum(double* values, std::size_t count) const {
  if (size() == 1) return;
  // Reduce and broadcast, not allreduce: replicated bodies must stay bitwise equal, and MPI does not promise that for allreduce.
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

bool Communicator::any(bool value) const { return max(value ? 1.0 : 0.0) > 0.0; }

}  // namespace furrow

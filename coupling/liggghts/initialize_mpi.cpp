// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/initialize_mpi.h"

#include <cstdlib>
#include <vector>

#include <mpi.h>

namespace furrow::coupling {

namespace {

/// mpirun and srun name the rank of each process that they start.
bool has_launcher() {
  for (const char* rank : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (std::getenv(rank) != nullptr) return true;
  return false;
}

/// Sets variables of the environment while it lives. Programs that a script starts later do not see
/// them.
class PassingEnvironment {
 public:
  void set_default(const char* name, const char* value) {
    if (std::getenv(name) != nullptr) return;
    setenv(name, value, 1);
    names_.push_back(name);
  }
  ~PassingEnvironment() {
    for (const char* name : names_) unsetenv(name);
  }

 private:
  std::vector<const char*> names_;
};

}  // namespace

void initialize_mpi(int* argc, char*** argv) {
  PassingEnvironment environment;
  if (!has_launcher()) {
    environment.set_default("OMPI_MCA_ess_singleton_isolated", "1");
    environment.set_default("OMPI_MCA_orte_create_session_dirs", "0");
    environment.set_default("OMPI_MCA_pml", "ob1");
    environment.set_default("OMPI_MCA_btl", "self");
    environment.set_default("OMPI_MCA_coll", "^adapt,han,inter,monitoring,sm,sync,tuned");
    environment.set_default("HWLOC_COMPONENTS", "-linuxio,-pci");
    environment.set_default("HWLOC_PLUGINS_PATH", "none");
  }
  // threads of another program take turns
  int provided = 0;
  MPI_Init_thread(argc, argv, argc ? MPI_THREAD_SINGLE : MPI_THREAD_SERIALIZED, &provided);
}

}  // namespace furrow::coupling

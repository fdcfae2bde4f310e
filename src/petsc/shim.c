#define _GNU_SOURCE
#include "shim.h"
#include <dlfcn.h>

PetscErrorCode mezha_malloc(size_t bytes, void **memory)
{
  return PetscMalloc(bytes, memory);
}

PetscErrorCode mezha_free(void *memory)
{
  return PetscFree(memory);
}

PetscErrorCode mezha_callback_error(const char *message)
{
  return PetscError(PETSC_COMM_SELF, __LINE__, __func__, __FILE__, PETSC_ERR_USER, PETSC_ERROR_INITIAL, "%s", message);
}

PetscErrorCode mezha_log_work(double operations)
{
  return PetscLogFlops(operations);
}

void mezha_restart_scotch(void)
{
  /* Scotch comes with PETSc, so its development files need not be there: look the function up. */
  void (*reset)(void) = (void (*)(void))dlsym(RTLD_DEFAULT, "SCOTCH_randomReset");
  if (reset) reset();
}

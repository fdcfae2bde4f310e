#include "shim.h"

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

#define _GNU_SOURCE
#include "shim.h"
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

static char kept_message[4096];

static PetscErrorCode keep_message(const char format[], ...)
{
  const size_t used = strlen(kept_message);
  va_list      values;
  va_start(values, format);
  vsnprintf(kept_message + used, sizeof(kept_message) - used, format, values);
  va_end(values);
  return 0;
}

void mezha_keep_messages(PetscBool keep)
{
  if (keep) {
    kept_message[0]         = 0;
    PetscErrorPrintf = keep_message;
  } else if (PetscErrorPrintf == keep_message) {
    PetscErrorPrintf = PetscErrorPrintfDefault;
  }
}

const char *mezha_kept_message(void)
{
  return kept_message;
}

static PetscBool end_is_ours;

/* PETSc ends some runs itself, with code 0, as after `-help intro`. */
static void refuse_end(void)
{
  if (!end_is_ours) return;
  fputs("mezha: a library has ended the program before its end; an option such as -help intro asks PETSc to\n", stderr);
  _exit(1);
}

void mezha_end_is_ours(PetscBool ours)
{
  static PetscBool known;
  if (!known && ours) known = atexit(refuse_end) == 0 ? PETSC_TRUE : PETSC_FALSE;
  end_is_ours = ours;
}

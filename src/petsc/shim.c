#define _GNU_SOURCE
#include "shim.h"
#include <petsc/private/pcimpl.h>
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

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

PetscErrorCode mezha_replace_apply(PC preconditioner, mezha_apply apply, mezha_apply *before)
{
  *before                    = preconditioner->ops->apply;
  preconditioner->ops->apply = apply;
  return 0;
}

void mezha_share_arena(void)
{
#ifdef M_ARENA_MAX
  mallopt(M_ARENA_MAX, 1);
#endif
}

int mezha_start_blas(size_t bytes)
{
  /* Volatile, so that memory that is given back at once is asked for all the same. */
  void *volatile memory = malloc(bytes);
  PetscBLASInt one    = 1;
  double       factor = 1.0, sum = 0.0;
  /* It comes along with PETSc. */
  typedef void (*Product)(const char *, const char *, const PetscBLASInt *, const PetscBLASInt *, const double *, const double *,
                          const PetscBLASInt *, const double *, double *, const PetscBLASInt *);
  Product product = (Product)dlsym(RTLD_DEFAULT, "dsyrk_");

  if (!memory) return 1;
  free(memory);
  if (product) product("U", "N", &one, &one, &factor, &factor, &one, &factor, &sum, &one);
  return 0;
}

PetscErrorCode mezha_record_residuals(KSP solver)
{
  return KSPSetResidualHistory(solver, NULL, PETSC_DETERMINE, PETSC_TRUE);
}

PetscErrorCode mezha_set_context_destructor(Mat shell, mezha_destructor destroy)
{
#if PETSC_VERSION_GE(3, 23, 0)
  return MatShellSetContextDestroy(shell, (PetscCtxDestroyFn *)destroy);
#else
  return MatShellSetContextDestroy(shell, destroy);
#endif
}

void *mezha_context_to_destroy(void *given)
{
#if PETSC_VERSION_GE(3, 23, 0)
  return *(void **)given;
#else
  return given;
#endif
}

/* Scotch comes with PETSc, so its development files need not be there: look its functions up. */
static void *scotch(const char *name)
{
  return dlsym(RTLD_DEFAULT, name);
}

void mezha_restart_scotch(void)
{
  void (*reset)(void) = (void (*)(void))scotch("SCOTCH_randomReset");
  if (reset) reset();
}

int mezha_scotch_number_size(void)
{
  int (*size)(void) = (int (*)(void))scotch("SCOTCH_numSizeof");
  return size ? size() : 0;
}

/* PETSc's own choices: the best of Scotch's strategies, and 1 % of imbalance. */
PetscErrorCode mezha_scotch_partition(int parts, int vertices, const int *offsets, const int *neighbours, const int *edge_weights,
                                      const int *vertex_weights, int *part)
{
  void *(*new_graph)(void)    = (void *(*)(void))scotch("SCOTCH_graphAlloc");
  void *(*new_strategy)(void) = (void *(*)(void))scotch("SCOTCH_stratAlloc");
  int (*init_graph)(void *)    = (int (*)(void *))scotch("SCOTCH_graphInit");
  int (*init_strategy)(void *) = (int (*)(void *))scotch("SCOTCH_stratInit");
  void (*exit_graph)(void *)    = (void (*)(void *))scotch("SCOTCH_graphExit");
  void (*exit_strategy)(void *) = (void (*)(void *))scotch("SCOTCH_stratExit");
  void (*release)(void *)       = (void (*)(void *))scotch("SCOTCH_memFree");
  int (*build)(void *, int, int, const int *, const int *, const int *, const int *, int, const int *, const int *) =
    (int (*)(void *, int, int, const int *, const int *, const int *, const int *, int, const int *, const int *))scotch("SCOTCH_graphBuild");
  int (*choose)(void *, int, int, double)    = (int (*)(void *, int, int, double))scotch("SCOTCH_stratGraphMapBuild");
  int (*divide)(void *, int, void *, int *) = (int (*)(void *, int, void *, int *))scotch("SCOTCH_graphPart");
  const int best = 1;
  int       failed = 1;
  if (new_graph && new_strategy && init_graph && init_strategy && exit_graph && exit_strategy && release && build && choose && divide) {
    void *graph = new_graph(), *strategy = new_strategy();
    if (graph && strategy && init_graph(graph) == 0) {
      if (init_strategy(strategy) == 0) {
        failed = build(graph, 0, vertices, offsets, NULL, vertex_weights, NULL, offsets[vertices], neighbours, edge_weights) ||
                 choose(strategy, best, parts, 0.01) || divide(graph, parts, strategy, part);
        exit_strategy(strategy);
      }
      exit_graph(graph);
    }
    if (graph) release(graph);
    if (strategy) release(strategy);
  }
  return failed ? mezha_callback_error("Scotch has not divided the graph") : 0;
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
  fputs("mezha: a library has ended the program before its end; an option such as -help intro asks PETSc to, and so may memory that a library does not get\n", stderr);
  _exit(1);
}

void mezha_end_is_ours(PetscBool ours)
{
  static PetscBool known;
  if (!known && ours) known = atexit(refuse_end) == 0 ? PETSC_TRUE : PETSC_FALSE;
  end_is_ours = ours;
}

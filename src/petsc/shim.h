/* What PETSc offers only as a macro or a variadic function, and what it does not pass on from its partitioner. */
#include <petscksp.h>

/* Memory that PETSc will free itself: `bytes` of it, or NULL with a non-zero code. */
PetscErrorCode mezha_malloc(size_t bytes, void **memory);
/* Gives back memory that PETSc has handed over. */
PetscErrorCode mezha_free(void *memory);
/* Enters an error of a callback into PETSc's error handling; returns its code. */
PetscErrorCode mezha_callback_error(const char *message);
/* Counts floating-point operations in PETSc's log. */
PetscErrorCode mezha_log_work(double operations);
/* Starts the random numbers of Scotch afresh, if this PETSc has loaded it. */
void mezha_restart_scotch(void);
/* Bytes of the numbers that this Scotch counts with; 0 if this PETSc has not loaded it. */
int mezha_scotch_number_size(void);
/* Divides a graph that this process has whole, by a Scotch with numbers of 4 bytes: `part` is that of each vertex. */
PetscErrorCode mezha_scotch_partition(int parts, int vertices, const int *offsets, const int *neighbours, const int *edge_weights,
                                      const int *vertex_weights, int *part);
/* From now on PETSc's words about errors are kept, or printed again. */
void mezha_keep_messages(PetscBool keep);
/* What was kept since the last start: the error, more about it, hints and a list of calls, a line each. */
const char *mezha_kept_message(void);
/* While `ours`, the end of this process from inside a library is a failure, whatever code it chooses. */
void mezha_end_is_ours(PetscBool ours);
/* What a preconditioner does, in place of what its kind does: its options, its parts and what PETSc shows of it stay. */
typedef PetscErrorCode (*mezha_apply)(PC, Vec, Vec);
/* The present one goes to `before`. */
PetscErrorCode mezha_replace_apply(PC preconditioner, mezha_apply apply, mezha_apply *before);
/* Threads that are started from now on share memory with the first one. */
void mezha_share_arena(void);
/* Has BLAS make a product, if `bytes` of memory are to be had for it; 0 if they are. */
int mezha_start_blas(size_t bytes);
/* Keeps the residual norm of each iteration of a solve, in memory of PETSc's. */
PetscErrorCode mezha_record_residuals(KSP solver);
/* What destroys the context of a shell, and the context in what it is given then: from PETSc 3.23 on, where the context is. */
typedef PetscErrorCode (*mezha_destructor)(void *);
PetscErrorCode mezha_set_context_destructor(Mat shell, mezha_destructor destroy);
void *mezha_context_to_destroy(void *given);
/* Sizes that PETSc works out, and its default real tolerance. */
static const PetscInt  mezha_determine    = PETSC_DETERMINE;
static const PetscReal mezha_default_real = PETSC_DEFAULT;

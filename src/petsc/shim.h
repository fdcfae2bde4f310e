/* What PETSc offers only as a macro, as a variadic function or as an array of names. */
#include <petscksp.h>

/* Memory that PETSc will free itself: `bytes` of it, or NULL with a non-zero code. */
PetscErrorCode mezha_malloc(size_t bytes, void **memory);
/* Gives back memory that PETSc has handed over. */
PetscErrorCode mezha_free(void *memory);
/* Enters an error of a callback into PETSc's error handling; returns its code. */
PetscErrorCode mezha_callback_error(const char *message);
/* Sizes that PETSc works out, and its default real tolerance. */
static const PetscInt  mezha_determine    = PETSC_DETERMINE;
static const PetscReal mezha_default_real = PETSC_DEFAULT;

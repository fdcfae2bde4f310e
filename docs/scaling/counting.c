/* Counts what a program sends and reduces, rank by rank, and what it takes from memory; a delay stands for the latency of a
 * network. A layer of MPI's profiling interface (MPI standard, chapter "Tool Support"), to be loaded before the library:
 *
 *     mpicc -shared -fPIC -O2 -o counting.so counting.c
 *     mpirun -n 4 -x LD_PRELOAD=$PWD/counting.so -x COUNTING=counts mezha run case.toml
 *
 * writes counts.RANK, a line of names and numbers. Counted are messages between two ranks and their bytes where they begin, how
 * many other ranks they go to, collectives of each kind, and the bytes that this rank hands to them.
 *
 * COUNTING_DELAY=SECONDS makes the end of each wait for messages, and each collective, last so much longer, once for all messages
 * that are waited for together, as on a network with that latency. A collective lasts that times the logarithm of the number of
 * ranks, as in a tree. */
#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

enum { MESSAGE, REDUCTION, SUM, GATHERING, BROADCAST, BARRIER, OTHER, KINDS };
static const char *NAMES[KINDS] = {"messages", "reductions", "sums", "gatherings", "broadcasts", "barriers", "others"};

enum { SMALL = 1024 };

static long long calls[KINDS], bytes[KINDS], waits;
static double delay;
static int ranks = 1, own;
static char *met;

static void start(void) {
    PMPI_Comm_size(MPI_COMM_WORLD, &ranks);
    PMPI_Comm_rank(MPI_COMM_WORLD, &own);
    met = calloc((size_t)ranks, 1);
    const char *text = getenv("COUNTING_DELAY");
    delay = text ? atof(text) : 0.0;
}

/* Sleeps: ranks that share a core do not hold each other up. */
static void hold(double seconds) {
    if (seconds <= 0.0) return;
    struct timespec rest = {(time_t)seconds, (long)(1e9 * (seconds - floor(seconds)))};
    nanosleep(&rest, NULL);
}

static void waited(void) {
    waits++;
    hold(delay);
}

static void count(int kind, long long n, MPI_Datatype type) {
    int size = 0;
    if (type != MPI_DATATYPE_NULL) PMPI_Type_size(type, &size);
    calls[kind]++;
    bytes[kind] += n * size;
}

static void together(int kind, long long n, MPI_Datatype type, MPI_Comm comm) {
    int size = 1, each = 0;
    PMPI_Comm_size(comm, &size);
    if (size < 2) return;
    PMPI_Type_size(type, &each);
    if (kind == REDUCTION && n * each > SMALL) kind = SUM;
    count(kind, n, type);
    hold(delay * ceil(log2((double)size)));
}

static void sent(int n, MPI_Datatype type, int to, MPI_Comm comm) {
    if (to == MPI_PROC_NULL) return;
    int world = to;
    MPI_Group here, all;
    PMPI_Comm_group(comm, &here);
    PMPI_Comm_group(MPI_COMM_WORLD, &all);
    PMPI_Group_translate_ranks(here, 1, &to, all, &world);
    PMPI_Group_free(&here);
    PMPI_Group_free(&all);
    if (met && world >= 0 && world < ranks && world != own) met[world] = 1;
    if (world != own) count(MESSAGE, n, type);
}

static void report(void) {
    const char *name = getenv("COUNTING");
    if (!name) return;
    char path[4096];
    snprintf(path, sizeof path, "%s.%d", name, own);
    FILE *file = fopen(path, "w");
    if (!file) return;
    int others = 0;
    for (int k = 0; k < ranks; k++) others += met[k];
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    for (int k = 0; k < KINDS; k++) fprintf(file, "%s %lld %s_bytes %lld ", NAMES[k], calls[k], NAMES[k], bytes[k]);
    fprintf(file, "waits %lld neighbours %d memory_kib %ld\n", waits, others, usage.ru_maxrss);
    fclose(file);
}

int MPI_Init(int *argc, char ***argv) {
    int code = PMPI_Init(argc, argv);
    start();
    return code;
}

int MPI_Init_thread(int *argc, char ***argv, int required, int *provided) {
    int code = PMPI_Init_thread(argc, argv, required, provided);
    start();
    return code;
}

int MPI_Finalize(void) {
    report();
    return PMPI_Finalize();
}

#define SEND(NAME)                                                                                     \
    int MPI_##NAME(const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c) {                \
        sent(n, t, to, c);                                                                             \
        return PMPI_##NAME(b, n, t, to, tag, c);                                                       \
    }
SEND(Send)
SEND(Ssend)
SEND(Rsend)
SEND(Bsend)

#define ISEND(NAME)                                                                                    \
    int MPI_##NAME(const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c, MPI_Request *r) { \
        sent(n, t, to, c);                                                                             \
        return PMPI_##NAME(b, n, t, to, tag, c, r);                                                    \
    }
ISEND(Isend)
ISEND(Issend)
ISEND(Irsend)

/* Messages that are prepared once and begun often: each request keeps what it sends. */
struct prepared { MPI_Request request; int n, to; MPI_Datatype type; MPI_Comm comm; struct prepared *next; };
static struct prepared *prepared[1024];

static unsigned place(MPI_Request request) { return (unsigned)(((size_t)request >> 5) % 1024); }

static void prepare(MPI_Request request, int n, MPI_Datatype type, int to, MPI_Comm comm) {
    struct prepared *new = malloc(sizeof *new);
    *new = (struct prepared){request, n, to, type, comm, prepared[place(request)]};
    prepared[place(request)] = new;
}

static void begun(MPI_Request request) {
    for (struct prepared *p = prepared[place(request)]; p; p = p->next)
        if (p->request == request) {
            sent(p->n, p->type, p->to, p->comm);
            return;
        }
}

#define PREPARE(NAME)                                                                                  \
    int MPI_##NAME(const void *b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c, MPI_Request *r) { \
        int code = PMPI_##NAME(b, n, t, to, tag, c, r);                                                \
        prepare(*r, n, t, to, c);                                                                      \
        return code;                                                                                   \
    }
PREPARE(Send_init)
PREPARE(Ssend_init)
PREPARE(Rsend_init)

int MPI_Request_free(MPI_Request *r) {
    for (struct prepared **p = &prepared[place(*r)]; *p; p = &(*p)->next)
        if ((*p)->request == *r) {
            struct prepared *gone = *p;
            *p = gone->next;
            free(gone);
            break;
        }
    return PMPI_Request_free(r);
}

int MPI_Start(MPI_Request *r) {
    begun(*r);
    return PMPI_Start(r);
}

int MPI_Startall(int n, MPI_Request r[]) {
    for (int k = 0; k < n; k++) begun(r[k]);
    return PMPI_Startall(n, r);
}

static int any(int n, const MPI_Request r[]) {
    for (int k = 0; k < n; k++)
        if (r[k] != MPI_REQUEST_NULL) return 1;
    return 0;
}

int MPI_Wait(MPI_Request *r, MPI_Status *s) {
    int wait = any(1, r), code = PMPI_Wait(r, s);
    if (wait) waited();
    return code;
}

int MPI_Waitall(int n, MPI_Request r[], MPI_Status s[]) {
    int wait = any(n, r), code = PMPI_Waitall(n, r, s);
    if (wait) waited();
    return code;
}

int MPI_Recv(void *b, int n, MPI_Datatype t, int from, int tag, MPI_Comm c, MPI_Status *s) {
    int code = PMPI_Recv(b, n, t, from, tag, c, s);
    waited();
    return code;
}

int MPI_Sendrecv(const void *b, int n, MPI_Datatype t, int to, int tag, void *rb, int rn, MPI_Datatype rt, int from, int rtag,
                 MPI_Comm c, MPI_Status *s) {
    sent(n, t, to, c);
    int code = PMPI_Sendrecv(b, n, t, to, tag, rb, rn, rt, from, rtag, c, s);
    waited();
    return code;
}

int MPI_Allreduce(const void *b, void *rb, int n, MPI_Datatype t, MPI_Op op, MPI_Comm c) {
    together(REDUCTION, n, t, c);
    return PMPI_Allreduce(b, rb, n, t, op, c);
}

int MPI_Iallreduce(const void *b, void *rb, int n, MPI_Datatype t, MPI_Op op, MPI_Comm c, MPI_Request *r) {
    together(REDUCTION, n, t, c);
    return PMPI_Iallreduce(b, rb, n, t, op, c, r);
}

int MPI_Reduce(const void *b, void *rb, int n, MPI_Datatype t, MPI_Op op, int root, MPI_Comm c) {
    together(REDUCTION, n, t, c);
    return PMPI_Reduce(b, rb, n, t, op, root, c);
}

int MPI_Scan(const void *b, void *rb, int n, MPI_Datatype t, MPI_Op op, MPI_Comm c) {
    together(OTHER, n, t, c);
    return PMPI_Scan(b, rb, n, t, op, c);
}

int MPI_Allgather(const void *b, int n, MPI_Datatype t, void *rb, int rn, MPI_Datatype rt, MPI_Comm c) {
    if (b == MPI_IN_PLACE) together(GATHERING, rn, rt, c);
    else together(GATHERING, n, t, c);
    return PMPI_Allgather(b, n, t, rb, rn, rt, c);
}

int MPI_Allgatherv(const void *b, int n, MPI_Datatype t, void *rb, const int rn[], const int at[], MPI_Datatype rt, MPI_Comm c) {
    int rank;
    PMPI_Comm_rank(c, &rank);
    if (b == MPI_IN_PLACE) together(GATHERING, rn[rank], rt, c);
    else together(GATHERING, n, t, c);
    return PMPI_Allgatherv(b, n, t, rb, rn, at, rt, c);
}

int MPI_Gather(const void *b, int n, MPI_Datatype t, void *rb, int rn, MPI_Datatype rt, int root, MPI_Comm c) {
    together(GATHERING, n, t, c);
    return PMPI_Gather(b, n, t, rb, rn, rt, root, c);
}

int MPI_Gatherv(const void *b, int n, MPI_Datatype t, void *rb, const int rn[], const int at[], MPI_Datatype rt, int root,
                MPI_Comm c) {
    together(GATHERING, n, t, c);
    return PMPI_Gatherv(b, n, t, rb, rn, at, rt, root, c);
}

int MPI_Bcast(void *b, int n, MPI_Datatype t, int root, MPI_Comm c) {
    together(BROADCAST, n, t, c);
    return PMPI_Bcast(b, n, t, root, c);
}

int MPI_Barrier(MPI_Comm c) {
    together(BARRIER, 0, MPI_BYTE, c);
    return PMPI_Barrier(c);
}

int MPI_Alltoall(const void *b, int n, MPI_Datatype t, void *rb, int rn, MPI_Datatype rt, MPI_Comm c) {
    together(OTHER, n, t, c);
    return PMPI_Alltoall(b, n, t, rb, rn, rt, c);
}

int MPI_Alltoallv(const void *b, const int n[], const int at[], MPI_Datatype t, void *rb, const int rn[], const int rat[],
                  MPI_Datatype rt, MPI_Comm c) {
    together(OTHER, 0, t, c);
    return PMPI_Alltoallv(b, n, at, t, rb, rn, rat, rt, c);
}

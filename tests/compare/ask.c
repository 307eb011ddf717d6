/* SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE /* fork, mmap without a file, setitimer */
#include "ask.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

/* Adds the peers of one module, all or none. Whether it could be loaded. */
static int load_module(peer_list *list, const char *path)
{
    peers_fn *peers;
    const peer *all;
    int count = 0;
    void *symbol, *module = *path ? dlopen(path, RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!module || !(symbol = dlsym(module, PEERS_FN))) {
        fprintf(stderr, "%s\n", *path ? dlerror() : "not built");
        return 0;
    }
    memcpy(&peers, &symbol, sizeof peers); /* C has no cast from object to function */
    all = peers(&count);
    if (count > MOST_PEERS - list->count) {
        fprintf(stderr, "too many peers\n");
        return 0;
    }
    for (int k = 0; k < count; k++) {
        list->all[list->count++] = &all[k];
    }
    return 1;
}

int load_peers(peer_list *list, int count, char **arguments)
{
    const char *needs = getenv("GJK_COMPARE_NEEDS");
    int needed = 0;
    for (int k = 0; k < count; k++) {
        char *path = strchr(arguments[k], '=');
        if (!path || list->missing_count == MOST_MODULES) {
            return -1;
        }
        *path++ = 0;
        if (!load_module(list, path)) {
            fprintf(stderr, "the peer %s is missing\n", arguments[k]);
            list->missing[list->missing_count++] = arguments[k];
            needed += needs && strstr(needs, arguments[k]);
        }
    }
    return needed;
}

void keep_usual(peer_list *list)
{
    int kept = 0;
    for (int k = 0; k < list->count; k++) {
        if (list->all[k]->usual && list->all[k]->memory == 0) {
            list->all[kept++] = list->all[k];
        }
    }
    list->count = kept;
}

static int first_of_library(const peer_list *list, int k)
{
    const peer *p = list->all[k];
    for (int i = 0; i < k; i++) {
        if (strcmp(list->all[i]->library, p->library) == 0 && list->all[i]->dim == p->dim) {
            return 0;
        }
    }
    return 1;
}

void print_peers(const peer_list *list)
{
    const char *comma = "";
    printf("\"peers\": [");
    for (int k = 0; k < list->count; k++) {
        const peer *p = list->all[k];
        if (first_of_library(list, k)) {
            const char *how = p->how[p->query[DISTANCE] ? DISTANCE : INTERSECT];
            printf("%s{\"name\": \"%s\", \"version\": \"%s\", \"how\": \"%s\", \"how_meet\": \"%s\", \"how_deep\": "
                   "\"%s\", \"dim\": %d, \"single\": %d, \"distances\": %d, \"asked\": [%d, %d]}",
                   comma, p->library, p->version, how, p->how[INTERSECT], p->how[PENETRATION], p->dim, p->single,
                   p->query[DISTANCE] != NULL, p->query[DISTANCE] || p->query[INTERSECT],
                   p->query[PENETRATION] != NULL);
            comma = ", ";
        }
    }
    printf("], \"missing\": [");
    for (int k = 0; k < list->missing_count; k++) {
        printf("%s\"%s\"", k ? ", " : "", list->missing[k]);
    }
    printf("]");
}

void *shared_space(size_t size)
{
    void *space = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (space == MAP_FAILED) {
        perror("mmap");
        exit(2);
    }
    return space;
}

void give_back(void *space, size_t size) { munmap(space, size); }

static int takes(const peer *p, const peer_set *s)
{
    if ((s->posed && !p->poses) || !(p->cores >> s->core & 1)) {
        return 0;
    }
    return s->core != PEER_POINTS ||
           (s->count > 0 && (p->most_points == 0 || s->count <= p->most_points) && (p->radii || s->radius == 0));
}

int takes_pair(const peer *p, const fed *pair)
{
    return p->dim == pair->dim && takes(p, &pair->a) && takes(p, &pair->b);
}

static int is_number(enum question question, const peer_answer *x)
{
    return question == INTERSECT  ? 1
           : question == DISTANCE ? isfinite(x->distance) != 0
                                  : x->meet != 1 || isfinite(x->depth);
}

void *make_body(const peer *p, const peer_set *set, const void *first)
{
    return first && p->again ? p->again(first, set) : p->make(set);
}

typedef struct couple {
    int is_made;
    void *a, *b;
} couple;

static couple make_couple(const peer *p, const fed *pair, const couple *first)
{
    couple made = {1, make_body(p, &pair->a, first ? first->a : NULL), make_body(p, &pair->b, first ? first->b : NULL)};
    return made;
}

/* The bodies of a pair, made when they are asked about first; after those of the first of the track. */
static const couple *couple_of(const peer *p, const fed *pairs, int i, int track, couple *made)
{
    int first = track ? i - i % track : i;
    if (!made[first].is_made) {
        made[first] = make_couple(p, &pairs[first], NULL);
    }
    if (!made[i].is_made) {
        made[i] = make_couple(p, &pairs[i], &made[first]);
    }
    return &made[i];
}

static void ask_one(const peer *p, enum question question, const couple *c, void *memory, reply *r)
{
    int failed = !c->a || !c->b || p->query[question](p, c->a, c->b, memory, &r->answer) != 0;
    r->outcome = failed || !is_number(question, &r->answer) ? GAVE_UP : ANSWERED;
}

/* From the pair `from` on; *at is kept at the one asked. */
static void ask_of_all(const peer *p, enum question question, const fed *pairs, int from, int count, int track,
                       couple *made, reply *replies, volatile int *at)
{
    const struct itimerval limit = {{0, 0}, {0, (int)(TIME_LIMIT * 1e6)}}, none = {{0, 0}, {0, 0}};
    void *memory = p->memory ? calloc(1, p->memory) : NULL;
    for (int i = from; i < count; i++, ++*at) {
        if (!takes_pair(p, &pairs[i])) {
            continue;
        }
        if (memory && (track == 0 || i % track == 0)) {
            memset(memory, 0, p->memory);
        }
        setitimer(ITIMER_VIRTUAL, &none, NULL); /* for what is made once, an index too, there is no limit */
        const couple *c = couple_of(p, pairs, i, track, made);
        setitimer(ITIMER_VIRTUAL, &limit, NULL);
        ask_one(p, question, c, memory, &replies[i]);
    }
    free(memory);
}

/* In the child, from *at on, which counts the pairs of one peer after another; all are asked about the same bodies.
 * What it dies of, if it does, is told by the signal. */
static void ask_the_rest(const peer *const *peers, int peer_count, enum question question, const fed *pairs, int count,
                         int track, reply *const *replies, volatile int *at)
{
    int nowhere = open("/dev/null", O_WRONLY);
    couple *made = calloc((size_t)count, sizeof *made);
    dup2(nowhere, 1);
    dup2(nowhere, 2);
    for (int k = *at / count; k < peer_count && made; k++) {
        ask_of_all(peers[k], question, pairs, *at - k * count, count, track, made, replies[k], at);
    }
    _exit(made ? 0 : 1);
}

void ask_peers(const peer *const *peers, int peer_count, enum question question, const fed *pairs, int count, int track,
               reply *const *replies)
{
    static volatile int *at;
    at = at ? at : shared_space(sizeof *at);
    for (int k = 0; k < peer_count; k++) {
        memset(replies[k], 0, (size_t)count * sizeof *replies[k]);
    }
    for (*at = 0; *at < peer_count * count; ++*at) {
        int status = 0;
        pid_t child;
        fflush(NULL);
        child = fork();
        if (child == 0) {
            ask_the_rest(peers, peer_count, question, pairs, count, track, replies, at);
        }
        while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
        }
        if (child < 0) {
            perror("fork");
            exit(2);
        }
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
            return;
        }
        replies[*at / count][*at % count].outcome =
            WIFSIGNALED(status) && WTERMSIG(status) == SIGVTALRM ? HUNG : CRASHED;
    }
}

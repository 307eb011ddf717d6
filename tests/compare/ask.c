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

/* Adds the peers of one module. Whether it could be loaded. */
static int load_module(peer_list *list, const char *path)
{
    peers_fn *peers;
    void *symbol, *module = *path ? dlopen(path, RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!module || !(symbol = dlsym(module, PEERS_FN))) {
        fprintf(stderr, "%s\n", *path ? dlerror() : "not built");
        return 0;
    }
    memcpy(&peers, &symbol, sizeof peers); /* C has no cast from object to function */
    for (const peer *const *p = peers(); *p && list->count < MOST_PEERS; p++) {
        list->all[list->count++] = *p;
    }
    return 1;
}

int load_peers(peer_list *list, int count, char **arguments)
{
    const char *needs = getenv("GJK_COMPARE_NEEDS");
    int needed = 0;
    for (int k = 0; k < count; k++) {
        char *path = strchr(arguments[k], '=');
        if (!path || list->missing_count == MOST_PEERS) {
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

void print_peers(const peer_list *list)
{
    printf("\"peers\": [");
    for (int k = 0; k < list->count; k++) {
        const peer *p = list->all[k];
        printf("%s{\"name\": \"%s\", \"version\": \"%s\", \"how\": \"%s\", \"how_deep\": \"%s\", \"dim\": %d, "
               "\"single\": %d, \"distances\": %d, \"asked\": [%d, %d]}",
               k ? ", " : "", p->name, p->version, p->how, p->how_deep, p->dim, p->single, p->distances,
               p->query != NULL, p->penetration != NULL);
    }
    printf("], \"missing\": [");
    for (int k = 0; k < list->missing_count; k++) {
        printf("%s\"%s\"", k ? ", " : "", list->missing[k]);
    }
    printf("]");
}

static void *shared(size_t size)
{
    void *space = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (space == MAP_FAILED) {
        perror("mmap");
        exit(2);
    }
    return space;
}

reply *reply_space(int count) { return shared((size_t)count * sizeof(reply)); }

peer_query *query_of(const peer *p, enum question question) { return question == HOW_FAR ? p->query : p->penetration; }

static int takes(const peer *p, const peer_set *s)
{
    if (s->core != PEER_POINTS || s->posed) {
        return p->cores;
    }
    return s->count > 0 && (p->most_points == 0 || s->count <= p->most_points) && (p->radii || s->radius == 0);
}

int takes_pair(const peer *p, const fed *pair) { return takes(p, &pair->a) && takes(p, &pair->b); }

static int is_number(const peer *p, enum question question, const peer_answer *x)
{
    return question == HOW_FAR ? !p->distances || isfinite(x->distance) : !x->meet || isfinite(x->depth);
}

static void ask_one(const peer *p, enum question question, const fed *pair, reply *r)
{
    void *a = p->make(&pair->a), *b = p->make(&pair->b);
    int failed = !a || !b || query_of(p, question)(a, b, &r->answer) != 0;
    r->outcome = failed || !is_number(p, question, &r->answer) ? GAVE_UP : ANSWERED;
    if (a) {
        p->discard(a);
    }
    if (b) {
        p->discard(b);
    }
}

/* In the child, from *at on. What it dies of, if it does, is told by the signal. */
static void ask_the_rest(const peer *p, enum question question, const fed *pairs, int count, reply *replies,
                         volatile int *at)
{
    struct itimerval limit = {{0, 0}, {0, (int)(TIME_LIMIT * 1e6)}};
    int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, 1);
    dup2(nowhere, 2);
    for (; *at < count; ++*at) {
        if (takes_pair(p, &pairs[*at])) {
            setitimer(ITIMER_VIRTUAL, &limit, NULL);
            ask_one(p, question, &pairs[*at], &replies[*at]);
        }
    }
    _exit(0);
}

void ask_peer(const peer *p, enum question question, const fed *pairs, int count, reply *replies)
{
    static volatile int *at;
    at = at ? at : shared(sizeof *at);
    memset(replies, 0, (size_t)count * sizeof *replies);
    for (*at = 0; *at < count; ++*at) {
        int status = 0;
        pid_t child;
        fflush(NULL);
        child = fork();
        if (child == 0) {
            ask_the_rest(p, question, pairs, count, replies, at);
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
        replies[*at].outcome = WIFSIGNALED(status) && WTERMSIG(status) == SIGVTALRM ? HUNG : CRASHED;
    }
}

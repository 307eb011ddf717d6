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

int load_peers(peer_list *list, const char *path)
{
    peers_fn *peers;
    void *symbol, *module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!module || !(symbol = dlsym(module, PEERS_FN))) {
        fprintf(stderr, "%s\n", dlerror());
        return 0;
    }
    memcpy(&peers, &symbol, sizeof peers); /* C has no cast from object to function */
    for (const peer *const *p = peers(); *p && list->count < MOST_PEERS; p++) {
        list->all[list->count++] = *p;
    }
    return 1;
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

static int takes(const peer *p, const peer_set *s)
{
    return s->count > 0 && (p->most_points == 0 || s->count <= p->most_points) && (p->radii || s->radius == 0);
}

static void ask_one(const peer *p, const fed *pair, reply *r)
{
    void *a = p->make(&pair->a), *b = p->make(&pair->b);
    int failed = !a || !b || p->query(a, b, &r->answer) != 0;
    r->outcome = failed || (p->distances && !isfinite(r->answer.distance)) ? GAVE_UP : ANSWERED;
    if (a) {
        p->discard(a);
    }
    if (b) {
        p->discard(b);
    }
}

/* In the child, from *at on. What it dies of, if it does, is told by the signal. */
static void ask_the_rest(const peer *p, const fed *pairs, int count, reply *replies, volatile int *at)
{
    struct itimerval limit = {{0, 0}, {0, (int)(TIME_LIMIT * 1e6)}};
    int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, 1);
    dup2(nowhere, 2);
    for (; *at < count; ++*at) {
        if (takes(p, &pairs[*at].a) && takes(p, &pairs[*at].b)) {
            setitimer(ITIMER_VIRTUAL, &limit, NULL);
            ask_one(p, &pairs[*at], &replies[*at]);
        }
    }
    _exit(0);
}

void ask_peer(const peer *p, const fed *pairs, int count, reply *replies)
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
            ask_the_rest(p, pairs, count, replies, at);
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

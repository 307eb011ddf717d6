/* SPDX-License-Identifier: MIT */
/* MuJoCo: the signed distance of two geoms of a model, in double; the corners of its meshes are floats. */
#include "peer.h"

#include <math.h>
#include <mujoco/mujoco.h>
#include <stdlib.h>
#include <string.h>

/* It asks about two geoms of one model, which is compiled when they are asked about first. */
typedef struct body {
    const peer_set *set;
    const struct body *other; /* that the model holds beside this one */
    mjModel *model;
} body;

static void *make(const peer_set *set)
{
    body *made = calloc(1, sizeof *made);
    if (made) {
        made->set = set;
    }
    return made;
}

static void discard(void *made)
{
    body *b = made;
    if (b->model) {
        mj_deleteModel(b->model);
    }
    free(b);
}

/* ---- models ---- */

static void add_mesh(mjSpec *spec, mjsGeom *geom, const peer_set *set, const char *name)
{
    mjsMesh *mesh = mjs_addMesh(spec, NULL);
    float *v = malloc((size_t)set->count * 3 * sizeof *v);
    for (int k = 0; k < 3 * set->count && v; k++) {
        v[k] = (float)set->v[k];
    }
    if (v) {
        mjs_setFloat(mesh->uservert, v, 3 * set->count);
    }
    mjs_setName(mesh->element, name);
    mjs_setString(geom->meshname, name);
    free(v);
}

/* Solids of revolution and capsules lie along the last axis there, too. */
static void add_geom(mjSpec *spec, const peer_set *set, const char *name)
{
    static const mjtGeom types[] = {mjGEOM_MESH, mjGEOM_BOX,       mjGEOM_CAPSULE, mjGEOM_CYLINDER,
                                    mjGEOM_MESH, mjGEOM_ELLIPSOID, mjGEOM_SPHERE};
    mjsGeom *geom = mjs_addGeom(mjs_findBody(spec, "world"), NULL);
    geom->type = types[set->core];
    memcpy(geom->size, set->size, sizeof geom->size);
    if (set->core == PEER_SEGMENT || set->core == PEER_ORIGIN) {
        geom->size[0] = set->radius;
        geom->size[1] = set->core == PEER_SEGMENT ? fabs(set->v[2]) : 0;
    }
    if (set->core == PEER_POINTS) {
        add_mesh(spec, geom, set, name);
    }
}

/* A mesh is turned to the axes of its inertia, and rounded; its corners are put back to where they were. */
static void put_corners_back(mjModel *m, int geom, const peer_set *set)
{
    int mesh = m->geom_dataid[geom];
    if (mesh >= 0 && m->mesh_vertnum[mesh] == set->count) {
        for (int k = 0; k < 3 * set->count; k++) {
            m->mesh_vert[3 * m->mesh_vertadr[mesh] + k] = (float)set->v[k];
        }
    }
}

static mjModel *model_of(const peer_set *a, const peer_set *b)
{
    mjSpec *spec = mj_makeSpec();
    mjModel *m;
    add_geom(spec, a, "a");
    add_geom(spec, b, "b");
    m = mj_compile(spec, NULL);
    mj_deleteSpec(spec);
    if (m) {
        put_corners_back(m, 0, a);
        put_corners_back(m, 1, b);
    }
    return m;
}

/* Of all models, which differ in their meshes alone. */
static mjData *data_of(const mjModel *m)
{
    static mjData *data;
    data = data ? data : mj_makeData(m);
    return data;
}

static void place(mjData *d, int geom, const peer_set *set)
{
    static const double nowhere[3], unturned[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(d->geom_xpos + 3 * geom, set->posed ? set->p : nowhere, sizeof nowhere);
    memcpy(d->geom_xmat + 9 * geom, set->posed ? set->m : unturned, sizeof unturned);
}

/* ---- questions ---- */

/* Below 0 where they overlap; not below `most` where they are further apart. Not 0: it cannot be asked. */
static int measure(const peer *p, const void *of, const void *with, double most, double *d, double *way)
{
    body *a = (body *)of; /* its model is made here */
    const body *b = with;
    mjData *data;
    if (a->other != b) {
        if (a->model) {
            mj_deleteModel(a->model);
        }
        a->model = model_of(a->set, b->set);
        a->other = b;
    }
    if (!a->model || !(data = data_of(a->model))) {
        return 1;
    }
    a->model->opt.ccd_tolerance = p->setting;
    place(data, 0, a->set);
    place(data, 1, b->set);
    *d = mj_geomDistance(a->model, data, 0, 1, most, way);
    return 0;
}

static int distance(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    double d;
    (void)memory;
    if (measure(p, a, b, 1e10, &d, NULL)) {
        return 1;
    }
    out->meet = !(d > 0);
    out->distance = out->meet ? 0 : d;
    return 0;
}

static int intersect(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    double d;
    (void)memory;
    if (measure(p, a, b, 0, &d, NULL)) {
        return 1;
    }
    out->meet = d < 0;
    return 0;
}

/* It says the two points; b is moved from its own to that of a. */
static int penetration(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    double way[6], d;
    (void)memory;
    if (measure(p, a, b, 0, &d, way)) {
        return 1;
    }
    out->meet = d < 0;
    out->depth = -d;
    for (int i = 0; i < 3 && out->meet; i++) {
        out->normal[i] = (way[i] - way[3 + i]) / -d;
    }
    return 0;
}

/* ---- settings ---- */

static void ignore(const char *warning) { (void)warning; }

#define OF_CORNERS 1e-6 /* what rounding them to float may do to a distance */

/* As it comes, first. */
const peer *gjk_peers(int *count)
{
    static const double tolerances[] = {1e-6, 1e-2, 1e-3, 1e-4, 1e-8, 1e-10, 1e-12};
    static peer all[sizeof tolerances / sizeof *tolerances];
    *count = (int)(sizeof tolerances / sizeof *tolerances);
    mju_user_warning = ignore; /* it would write a file */
    for (int k = 0; k < *count; k++) {
        peer *p = &all[k];
        *p = tolerant_peer("MuJoCo", tolerances[k], k == 0, PEER_VERSION);
        p->how[DISTANCE] = p->how[INTERSECT] = p->how[PENETRATION] = "mj_geomDistance, corners in float";
        p->cores = ALL_CORES & ~CORE(CONE);
        p->make = make;
        p->discard = discard;
        p->query[DISTANCE] = distance;
        p->query[INTERSECT] = intersect;
        p->query[PENETRATION] = penetration;
        for (int question = 0; question < QUESTIONS; question++) {
            p->tolerance[question] = fmax(tolerances[k], OF_CORNERS);
        }
    }
    return all;
}

/* SPDX-License-Identifier: GPL-2.0-or-later
 * How an outside structure code serves fix wall/nurbs of LIGGGHTS, in C99 or whatever can look like it:
 *
 *   fix net all wall/nurbs model hertz tangential history type 2 &
 *       structure plugin libnet.so net.txt surface top
 *
 * The shared library exports one function, structure_plugin(), which gives a table of functions.  The host
 * opens a body, asks for its skin (NURBS patches whose control points hang on nodes of the body), and then,
 * in each time step dt of the particles,
 *
 *   begin_step   v(n+1/2) = v(n) + dt/2 a(n),  x(n+1) = x(n) + dt v(n+1/2)
 *   motion       the host takes x(n+1) and v(n+1/2) of the nodes, and finds contacts and their forces F(n+1)
 *   end_step     a(n+1) = (F(n+1) + the body's own forces at x(n+1)) / m,  v(n+1) = v(n+1/2) + dt/2 a(n+1)
 *
 * Particles and surface so stand at one time level; a surface that is a step late gains energy.
 *
 * Numbers are in the consistent units that the description names.  Arrays of vectors are x, y, z of the first
 * node, of the second, ...  Functions that return int give 0, or a code of their own if they fail: the host
 * then asks for last_error, and ends the run on all ranks with library, function, code and text.  Every
 * function but last_error is called on all ranks, in the same order; a body whose ranks talk to each other
 * must not leave one waiting when another returns an error.  One thread calls.
 */
#ifndef NURBS_STRUCTURE_PLUGIN_H
#define NURBS_STRUCTURE_PLUGIN_H

#include <mpi.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Grows when what is there changes.  What is only added comes last in a struct, and its `size` tells. */
#define STRUCTURE_PLUGIN_VERSION 1u

/* The library's own. */
typedef struct StructurePluginBody StructurePluginBody;

/* What the host says when it opens a body; valid during the call. */
typedef struct StructurePluginSetup {
  uint32_t size;         /* sizeof(StructurePluginSetup) in the host */
  MPI_Fint communicator; /* of all ranks, for MPI_Comm_f2c; to be duplicated before messages are sent in it */
  const char* model;     /* the deck's word after the library: a file, as a rule */
  const char* surface;   /* the deck's name of the part of the skin that particles see */
} StructurePluginSetup;

/* A patch of the skin; control point (i, j) is i + n_xi * j, n = knot_count - degree - 1. */
typedef struct StructurePluginPatch {
  int32_t degree[2]; /* 1 to 6 */
  int32_t knot_count[2];
  const double* knots[2]; /* rising; the first and last degree + 1 times, others at most degree times */
  const double* weights;  /* > 0, one per control point; NULL: all are 1 */
  int32_t outward;        /* 1, -1: the normal dS/dxi x dS/deta points out of, into the body; 0: two-sided */
} StructurePluginPatch;

/* The host hands it over zeroed, with `size` set.  Pointers stay valid until close. */
typedef struct StructurePluginDescription {
  uint32_t size;        /* sizeof(StructurePluginDescription) in the host */
  const char* units;    /* "si", "cgs", "mm-g-ms" or "mm-t-s" */
  const char* identity; /* what a saved state belongs to, beside skin and library; NULL: nothing more */

  /* The skin, the same on every rank.  Control points of all patches are counted one patch after the other.
   * Edges of patches whose control points hang on the same nodes are welded. */
  int32_t patch_count;
  const StructurePluginPatch* patches;
  int64_t node_count; /* of nodes that the skin hangs on, on all ranks; ids are 0 to node_count - 1 */
  /* Control point c stands at the sum of factor[k] * x(node[k]), k from first[c] to first[c + 1] - 1, and its
   * forces go to the nodes in the same shares.  All three NULL: control point c is node c. */
  const int64_t* first; /* [control points + 1], from 0, rising */
  const int64_t* node;
  const double* factor;

  /* The nodes of this rank: those that motion gives and forces are for. */
  int32_t in_parts; /* 0: every rank has all nodes and moves them alike; 1: each node is one rank's, and
                       all nodes of a control point are the same rank's */
  int64_t own_count;
  const int64_t* own;         /* ids, rising; NULL: all of them */
  const double* inverse_mass; /* [own_count][3] [1/mass], 0 where a direction is held; NULL: not known */

  double youngs_modulus, poissons_ratio; /* of the skin, compared with the deck's; E = 0: not known */
} StructurePluginDescription;

/* Of a body that is in parts, this rank's share: the host adds them up.  Work is since `initialise`. */
typedef struct StructurePluginTotals {
  uint32_t size;                          /* sizeof(StructurePluginTotals) in the host; the rest is zeroed */
  double kinetic_energy, strain_energy;   /* [energy]; kinetic: sum of m |v|^2 / 2 */
  double linear_momentum[3];              /* sum of m v */
  double angular_momentum[3];             /* about the origin, sum of x cross m v */
  double load_work, support_work, damped; /* [energy] by its loads, by supports that move, taken by damping;
                                             a half kick by F that takes v to v' does dt/2 F . (v + v')/2 */
} StructurePluginTotals;

typedef struct StructurePlugin {
  uint32_t version; /* STRUCTURE_PLUGIN_VERSION as the library was compiled */
  uint32_t size;    /* sizeof(StructurePlugin) likewise */
  const char* name; /* of the solver, for messages */

  /* Makes the body at rest, or as the model has it, and sets *body; on failure last_error(NULL) is asked. */
  int (*open)(const StructurePluginSetup* setup, StructurePluginBody** body);
  void (*close)(StructurePluginBody* body);
  /* What went wrong in the last function that failed on this rank; the library's own text, never NULL. */
  const char* (*last_error)(const StructurePluginBody* body);
  int (*describe)(StructurePluginBody* body, StructurePluginDescription* description);

  /* Largest stable dt [time], as the body is now; asked before each run, and between steps. */
  int (*stable_step)(StructurePluginBody* body, double* dt);
  /* Before each run, and when the deck changes it: never above the stable step. */
  int (*set_time_step)(StructurePluginBody* body, double dt);
  /* Accelerations under forces [own_count][3] [force] for the state as it is; advances nothing, and begins
   * the work of the totals anew.  Before each run. */
  int (*initialise)(StructurePluginBody* body, const double* forces);
  int (*begin_step)(StructurePluginBody* body);
  int (*end_step)(StructurePluginBody* body, const double* forces);
  /* Fills x [length] and v [length/time], both [own_count][3]: v(n+1/2) between begin_step and end_step. */
  int (*motion)(StructurePluginBody* body, double* x, double* v);
  int (*totals)(StructurePluginBody* body, StructurePluginTotals* totals);

  /* Between steps: the state of the whole body as bytes.  With bytes NULL sets *size [bytes] alone, else
   * writes so many. Those of rank 0 count; others take part, and may give 0. */
  int (*save)(StructurePluginBody* body, void* bytes, int64_t* size);
  /* The same bytes on every rank, which may be of another number than those that saved: what follows is to be
   * the same motion, to the last bit. */
  int (*load)(StructurePluginBody* body, const void* bytes, int64_t size);

  /* The deck's gravity from now on, constant [length/time^2]; NULL: the body has loads of its own alone. */
  int (*set_gravity)(StructurePluginBody* body, const double gravity[3]);
} StructurePlugin;

/* The function that a library exports.  `version`: the host's STRUCTURE_PLUGIN_VERSION.  The table lives as
 * long as the library; NULL: that version is not served. */
typedef const StructurePlugin* (*StructurePluginEntry)(uint32_t version);
#define STRUCTURE_PLUGIN_ENTRY "structure_plugin"

#ifdef __cplusplus
}
#endif

#endif

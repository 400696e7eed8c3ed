/* A plug-in of relock is a shared library with one function, relock_plugin_v1, that gives a table of detectors
   and trackers. This is plain C, so that any language can fill the table and no compiler, standard library or
   OpenCV need be the same on both sides. Who writes C++ includes core/plugin.h instead, which fills it.

   Rules
   - Whatever the plug-in gives (the table and all that it points to) stays as it is until the program ends: a
     plug-in is never unloaded.
   - Whatever is handed to a function, in either direction, lives until that function returns: both sides copy
     what they keep. The pixels of a frame are relock's and must not be written to.
   - No exception and no longjmp may leave a function of the plug-in. A fault is told through relock_answer.
   - One object serves one run (a detector) or one start (a tracker), from one thread. Other objects may be at
     work on other threads.
   - The version stays 1 as long as structs only grow at their end: each begins with its size, or its size is
     in the table, and a reader reads no further than that. relock_setting, relock_box, relock_image and
     relock_curve never change.

   Coordinates are pixels, x to the right, y down, pixel centres at integers: a box of the pixels 10 to 29 has
   its left edge at 9.5 and a width of 20. All texts are UTF-8 and end in a zero byte. */
#ifndef RELOCK_CORE_PLUGIN_ABI_H
#define RELOCK_CORE_PLUGIN_ABI_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RELOCK_PLUGIN_ABI 1u

/* One option that a method has. */
typedef struct relock_option {
  const char* name;          /* lower case letters, digits and _ */
  const char* default_value; /* as it would be typed */
  const char* unit;          /* "px", "s", ...; "" for a pure number, a word or a switch */
  const char* sentence;      /* what it does */
} relock_option;

/* One option as it was given. */
typedef struct relock_setting {
  const char* name;
  const char* value;
} relock_setting;

typedef struct relock_box {
  double x, y;          /* left and top edge, px */
  double width, height; /* px */
} relock_box;

enum { RELOCK_GRAY8 = 0, RELOCK_BGR8 = 1 }; /* one byte a pixel; blue, green, red */

typedef struct relock_image {
  const uint8_t* data;   /* the first row; NULL: no picture */
  uint64_t stride;       /* bytes from one row to the next */
  int32_t width, height; /* px */
  uint32_t format;       /* RELOCK_GRAY8 or RELOCK_BGR8 */
  uint32_t unused;       /* 0 */
} relock_image;

typedef struct relock_frame {
  uint64_t size;       /* of this struct, bytes */
  int64_t index;       /* rank among the recorded frames; frames that were dropped leave holes */
  int64_t captured_ns; /* when it was captured, from the recording's epoch */
  relock_image image;
} relock_frame;

enum { RELOCK_CENTRE_OUTLINE = 0, RELOCK_CENTRE_PROJECTED = 1 };
enum { RELOCK_OUTLINE_BOX = 0, RELOCK_OUTLINE_QUAD = 1, RELOCK_OUTLINE_ELLIPSE = 2 };

/* Where a target is. */
typedef struct relock_sighting {
  uint64_t size;             /* of this struct, bytes */
  double centre_x, centre_y; /* px */
  uint32_t centre_kind;      /* of the outline, or the image of the target's physical centre */
  uint32_t outline_kind;
  /* box: x, y, width, height; quad: x, y of top left, top right, bottom right, bottom left;
     ellipse: x, y of its centre, both semi-axes (the longer first), direction of the longer in [0, pi) */
  double outline[8];
  const char* code_family; /* what was read, "aruco6x6_250" and "23"; NULL, both: nothing was read */
  const char* code_value;
  double confidence;         /* in [0, 1] */
  double blur_direction_rad; /* in [0, pi), from +x towards +y */
  double blur_length_px;     /* negative: not estimated */
} relock_sighting;

/* One line of a chart. */
typedef struct relock_curve {
  const char* name;     /* "": the only one */
  const double* points; /* x and y of the first one, of the second one, ... */
  uint64_t count;       /* of points */
} relock_curve;

/* One step of a detector's work on one picture, made to be looked at: a picture or a chart. */
typedef struct relock_stage {
  uint64_t size;        /* of this struct, bytes */
  const char* name;     /* one word: "filter" */
  const char* sentence; /* what is to be seen, with the figures of this picture */
  relock_image picture; /* its data are NULL: it is a chart */
  const char* x;        /* chart: titles of the axes, with their units */
  const char* y;
  const relock_curve* curves;
  uint64_t curve_count;
} relock_stage;

/* What a function of the plug-in answers through; `host` goes back into each of its functions. */
typedef struct relock_answer {
  uint64_t size; /* of this struct, bytes */
  void* host;
  /* One more sighting, best first. None: "it is not there". */
  void (*sighting)(void* host, const relock_sighting* seen);
  /* One more family of codes. */
  void (*code_family)(void* host, const char* family);
  /* What is at fault, in one sentence; whatever else was answered no longer counts. */
  void (*error)(void* host, const char* sentence);
  /* One more stage, in their order. There for who is asked to explain; an older relock asks nobody. */
  void (*stage)(void* host, const relock_stage* stage);
} relock_answer;

enum { RELOCK_DETECTOR = 1, RELOCK_TRACKER = 2 };
enum {
  RELOCK_NOT_DETERMINISTIC = 1, /* a tracker whose answers differ from run to run with the same seed */
  RELOCK_HONOURS_EXPECT = 2     /* a tracker that `expect` makes look elsewhere */
};

/* A detector or a tracker that can be asked for by name. Settings are always all options that it lists, sorted
   by name. */
typedef struct relock_method {
  uint32_t kind;        /* RELOCK_DETECTOR or RELOCK_TRACKER */
  uint32_t flags;       /* RELOCK_NOT_DETERMINISTIC | RELOCK_HONOURS_EXPECT */
  const char* name;     /* letters, digits, _ - . + */
  const char* sentence; /* what it is */
  const relock_option* options;
  uint64_t option_count;
  void* own; /* whatever the plug-in likes: it goes back into reads and create */

  /* Detectors: the families of the codes that it reads with these settings. NULL: it reads no codes. */
  void (*reads)(void* own, const relock_setting* settings, uint64_t count, const relock_answer* answer);
  /* A new object; NULL after an error. `seed` is for methods that draw at random. */
  void* (*create)(void* own, const relock_setting* settings, uint64_t count, uint64_t seed,
                  const relock_answer* answer);
  void (*destroy)(void* object);

  /* Detectors: all targets in the picture. `where`: look only here; may be NULL. */
  void (*detect)(void* object, const relock_image* image, const relock_box* where,
                 const relock_answer* answer);

  /* Trackers: the target is in this frame at this box; called once, before any track. */
  void (*start)(void* object, const relock_frame* frame, const relock_box* box, const relock_answer* answer);
  /* Trackers: where it is in the next frame that was delivered; at most one sighting. */
  void (*track)(void* object, const relock_frame* frame, const relock_answer* answer);
  /* Trackers: a hint before track, it is thought to be here, give or take sigma_px. May be NULL. */
  void (*expect)(void* object, const relock_box* prior, double sigma_px, const relock_answer* answer);

  /* Detectors: the stages of what detect does with the same arguments, the last one its answer. Returns 0 when
     this object shows none, else 1; asked with `image` NULL it only says which. May be NULL: none shows any. */
  int (*explain)(void* object, const relock_image* image, const relock_box* where,
                 const relock_answer* answer);
} relock_method;

/* Everything that a plug-in brings. */
typedef struct relock_plugin {
  uint32_t abi;         /* RELOCK_PLUGIN_ABI */
  uint32_t size;        /* sizeof(relock_plugin) */
  uint32_t method_size; /* sizeof(relock_method): from one of the methods to the next */
  uint32_t option_size; /* sizeof(relock_option): from one of the options to the next */
  const char* name;     /* of the plug-in, for people */
  const char* error;    /* NULL, or why it cannot serve here, in one sentence: no such device, no licence */
  const relock_method* methods;
  uint64_t method_count;
} relock_plugin;

/* The one function that relock looks for. `abi`: the version that relock speaks. NULL: the plug-in does not
   speak it. */
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
const relock_plugin*
relock_plugin_v1(uint32_t abi);

#ifdef __cplusplus
}
#endif

#endif

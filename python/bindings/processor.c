/* The module raytube._processor, which the package imports before raytube._core: an ImportError with a sentence where loading that one would
 * end Python with an illegal instruction. Compiled for any x86-64. */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "core/processor.h"

static struct PyModuleDef definition = {PyModuleDef_HEAD_INIT, .m_name = "raytube._processor", .m_size = -1};

PyMODINIT_FUNC PyInit__processor(void) {
  if (has_x86_64_v3()) return PyModule_Create(&definition);
  PyErr_SetString(PyExc_ImportError, processor_sentence);
  return NULL;
}

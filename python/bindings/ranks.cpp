#include "bindings/ranks.h"

#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <new>
#include <string>

#include "bindings/interruptible.h"
#include "core/error.h"

namespace raytube::python {

namespace py = pybind11;

namespace {

// Exit codes of the program: by the first one the others know whose fault it is.
enum Code : int { fell_short = 1, bad_input = 2 };

// Beside the module, as in a wheel or in a build tree, or where the package of the system has it.
SharedRanks ranks_of(int communicator, const std::filesystem::path& folder) {
  return interruptibly([=](Watch&) {
    return SharedRanks(ranks_of_communicator(communicator, {folder, folder / RAYTUBE_PLUGINS}));
  });
}

// Whatever Python has raised before the work began. Who is interrupted does not wait for the others.
void give_up_for(const SharedRanks& ranks, const std::string& sentence, bool is_input, bool wait) {
  const auto tell = [=] {
    ranks->fail(is_input ? bad_input : fell_short, sentence);
    ranks->end();
  };
  if (!wait) return Workers::begin(tell);
  interruptibly([=](Watch&) {
    tell();
    return true;
  });
}

}  // namespace

void give_up(Ranks& ranks, const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const InputError& bad) {
    ranks.fail(bad_input, bad.what());
  } catch (const Interrupted&) {
    ranks.fail(fell_short, "interrupted");
  } catch (const std::bad_alloc&) {
    ranks.fail(fell_short, "out of memory");
  } catch (const std::exception& other) {
    ranks.fail(fell_short, other.what());
  }
  ranks.end();
}

void bind_ranks(py::module_& module) {
  py::class_<Ranks, SharedRanks>(module, "Ranks").def_property_readonly("leads", &Ranks::leads).def("give_up", &give_up_for);
  module.def("ranks_of", &ranks_of);
}

}  // namespace raytube::python

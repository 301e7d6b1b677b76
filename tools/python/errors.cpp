// Failures as Python's exceptions.
#include <map>
#include <string>
#include <utility>

#include "drape/ensemble.h"
#include "module.h"
#include "run/failure.h"

namespace drape::python {

namespace {

/// Makes drape.Error and one class below it for each way to fail, with `exit_code` as the command line has it.
class Errors {
  public:
    explicit Errors(py::module_& module) {
        base_ = make(module, "Error", PyExc_RuntimeError, ExitCode::usage,
                     "The library was asked for what it cannot do; exit_code is the command line's.");
        action_ = make(module, "ActionError", base_.ptr(), ExitCode::usage,
                       "Actions that an ensemble cannot take; `member` says whose.");
        for (const auto& [code, name, help] : kinds) classes_[code] = make(module, name, base_.ptr(), code, help);
    }
    void raise(const Failure& failure) const {
        const auto found = classes_.find(failure.code);
        PyErr_SetString((found == classes_.end() ? base_ : found->second).ptr(), failure.text.c_str());
    }

    void raise(const ActionError& error) const {
        const py::object raised = action_(error.what());
        raised.attr("member") = error.member();
        PyErr_SetObject(action_.ptr(), raised.ptr());
    }

  private:
    struct Kind {
        ExitCode code;
        const char *name, *help;
    };
    static constexpr Kind kinds[] = {
        {ExitCode::io, "FileError", "A file could not be read."},
        {ExitCode::scene, "SceneError", "A scene is wrong: all of its errors, each with its place."},
        {ExitCode::device, "DeviceError", "No usable device, a failing Vulkan call, or not enough memory."},
        {ExitCode::diverged, "DivergedError", "A frame is not finite, or not plausible."},
        {ExitCode::tolerance, "ToleranceError", "A frame misses the scene's tolerance, or what method auto keeps."}};

    static py::object make(py::module_& module, const char* name, PyObject* base, ExitCode code, const char* help) {
        py::dict members;
        members["exit_code"] = static_cast<int>(code);
        members["__doc__"] = help;
        const std::string full = std::string("drape.") + name;
        auto type = py::reinterpret_steal<py::object>(PyErr_NewException(full.c_str(), base, members.ptr()));
        module.attr(name) = type;
        return type;
    }

    py::object base_, action_;
    std::map<ExitCode, py::object> classes_;
};

}  // namespace

void translate_errors(py::module_& module) {
    static const Errors* const errors = new Errors(module);  // lives as long as the interpreter's modules do
    py::register_exception_translator([](std::exception_ptr raised) {
        try {
            std::rethrow_exception(std::move(raised));
        } catch (const ActionError& error) {
            errors->raise(error);
        } catch (const Error& error) {
            Failure failure = current_failure();
            if (failure.code == ExitCode::internal) failure.text = error.what();  // it tells what was asked wrongly
            errors->raise(failure);
        }
    });
}

}  // namespace drape::python

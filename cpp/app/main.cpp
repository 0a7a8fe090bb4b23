// mlt-render: the flags of `pymlt render`, without Python on the machine.
//
// Exit codes: 0 done; 2 a mistake in usage or in the scene, or an output that cannot be written,
// found before the work began; 3 the render failed, or an output at its end is not where it was
// asked for; 129, 130 and 143 interrupted by SIGHUP, SIGINT or SIGTERM, with what was rendered
// saved.

#include "app/built_in_scenes.h"
#include "app/flags.h"
#include "app/options.h"
#include "app/progress_line.h"
#include "app/streams.h"
#include "base/atomic_file.h"
#include "image/exposure.h"
#include "job/checkpoint.h"
#include "job/output.h"
#include "job/plugins.h"
#include "mlt_version.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>

namespace mlt {
namespace {

volatile std::sig_atomic_t caught_signal = 0;
volatile std::sig_atomic_t something_to_save = 0;

void on_signal(int signal) {
  if (!something_to_save) _exit(128 + signal);
  caught_signal = signal;
}

/// Installs signal handlers; a program started by nohup keeps ignoring SIGHUP.
void catch_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  for (const int broken_output : {SIGPIPE, SIGXFSZ}) std::signal(broken_output, SIG_IGN);
}

FlagValue read(const Flag& flag, const std::string& text) {
  try {
    return read_flag(flag, text);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("argument {}: {}", flag.spelling, error.what()));
  }
}

void declare(CLI::App& app, FlagValues& given) {
  using Texts = std::vector<std::string>;
  for (const Flag& flag : render_flags()) {
    if (flag.is(Flag::python_only)) continue;
    if (!flag.type) {
      app.add_flag_callback(
          flag.spelling, [&flag, &given] { given[flag.name].emplace_back(); }, flag.help);
      continue;
    }
    CLI::Option* option = app.add_option_function<Texts>(
        flag.spelling,
        [&flag, &given](const Texts& texts) {
          for (const std::string& text : texts) given[flag.name].push_back(read(flag, text));
        },
        flag.help);
    option->type_name(flag.metavar)->required(flag.is(Flag::required))->allow_extra_args(false);
    if (!flag.is(Flag::repeatable)) option->expected(1);
  }
  app.set_version_flag("--version", "mlt-render " MLT_VERSION);
}

Options parse(int argc, char** argv) {
  CLI::App app("Renders a Mitsuba scene, by path tracing or Metropolis light transport.");
  FlagValues given;
  declare(app, given);
  try {
    app.parse(argc, argv);
    std::set<std::string> names;
    for (const auto& [name, values] : given) names.insert(name);
    check_flags(names);
  } catch (const CLI::Success& help) {
    std::exit(app.exit(help));
  } catch (const std::exception& error) {
    throw UsageError(fmt::format("{}; see mlt-render --help", error.what()));
  }
  return read_options(given);
}

/// Renders until the budget is used up, a signal arrives, or it fails; returns the exception.
std::exception_ptr render(Job& job, bool quiet) {
  ProgressLine line(quiet);
  something_to_save = 1;
  try {
    job.start();
    while (!job.wait(0.1)) {
      if (caught_signal) job.cancel();
      line.update(job.progress(), job.spp_done());
    }
    return nullptr;
  } catch (const RenderError&) {
    return std::current_exception();
  }
}

/// The outcome of writing all outputs; problems are reported as they occur.
struct Outputs {
  std::vector<std::string> images;  ///< Paths of the image files.
  bool complete = true;             ///< Whether all files are where they were asked for.

  void add(const Saved& saved) {
    if (saved.problem.empty()) return;
    say("{}", saved.problem);
    complete = false;
  }
};

Outputs save(const Options& options, const RenderedImage& render, const Stats& stats,
             WriteOptions write) {
  write.exposure = options.exposure ? *options.exposure : fitting_exposure(render.image);
  Outputs outputs;
  for (const std::string& path : options.outputs) {
    const Saved saved = save_render(path, render, write);
    outputs.add(saved);
    if (!saved.path.empty()) outputs.images.push_back(saved.path);
  }
  if (!options.stats.empty()) outputs.add(save_text(options.stats, to_json(stats)));
  return outputs;
}

/// Prints all but the first `known` warnings.
void print_warnings(const Stats& stats, size_t known = 0) {
  for (size_t i = known; i < stats.warnings.size(); ++i) say("warning: {}", stats.warnings[i]);
}

void warn_of_lost_alpha(const std::vector<std::string>& outputs) {
  for (const std::string& path : outputs)
    if (const std::string problem = alpha_problem(path); !problem.empty())
      say("warning: {}", problem);
}

/// A summary: samples, time and error.
std::string summary(const Stats& stats) {
  std::string error;
  if (std::isfinite(stats.error))
    error = fmt::format(stats.error >= 0.1 ? ", error {:.0f} %" : ", error {:.2g} %",
                        100 * stats.error);
  return fmt::format("{}, {} x {}, {:.4g} spp in {:.1f} s{}", stats.integrator, stats.width,
                     stats.height, stats.spp_done, stats.seconds_bootstrap + stats.seconds_render,
                     error);
}

int run(Options options) {
  for (const std::string& path : options.outputs) check_writable(path);
  if (!options.stats.empty()) check_file_writable(options.stats);
  if (!options.scene.empty()) options.scene = scene_file(options.scene);
  std::optional<Checkpoint> saved;
  if (!options.resume.empty()) {
    saved = read_checkpoint(options.resume);
    options.render.seed = saved->seed;
  }
  if (!options.checkpoint.path.empty()) check_checkpoint_writable(options.checkpoint.path);
  const LoadedScene loaded = saved ? load_scene(*saved, options.resume, options.scene, plugins())
                                   : load_file(options.scene, plugins(), options.load);
  const MadeIntegrator made = with_light_layers(
      make_integrator(
          saved ? saved->integrator
                : choose_integrator(loaded, options.integrator, options.parameters, plugins()),
          plugins()),
      options.light, plugins());
  ask_for_layers(options.aovs.empty() ? loaded.aovs : options.aovs, loaded, options.render);
  options.render.hide_emitters = made.hide_emitters;
  if (!options.checkpoint.path.empty())
    options.render.autosave =
        autosave_to(options.checkpoint, checkpoint_of(loaded, made, options.render.seed));
  Job job(loaded.scene, made.integrator, options.render);
  if (saved) resume(job, *saved, options.resume);
  saved.reset();
  const size_t known = render_stats(job, loaded, made).warnings.size();
  if (!options.quiet) {
    print_warnings(render_stats(job, loaded, made));
    if (job.has_alpha()) warn_of_lost_alpha(options.outputs);
  }

  const std::exception_ptr failure = render(job, options.quiet);
  const int signal = caught_signal;
  const Stats stats = render_stats(job, loaded, made);
  if (failure && stats.spp_done == 0) std::rethrow_exception(failure);
  if (!options.quiet) print_warnings(stats, known);
  if (signal && stats.spp_done == 0) {
    say("interrupted before the first sample; nothing to save");
    return 128 + signal;
  }
  WriteOptions write;
  write.half = loaded.scene->film().half_precision;
  write.metadata = render_metadata(stats, loaded, made, options.render);
  const Outputs outputs = save(options, {job.image(), job.layers()}, stats, write);
  if (failure) std::rethrow_exception(failure);
  if (!options.quiet)
    say("{}{}: {}", signal ? "interrupted; " : "", summary(stats),
        outputs.images.empty() ? "no image could be saved"
                               : fmt::format("{}", fmt::join(outputs.images, ", ")));
  if (!outputs.complete) return 3;
  return signal ? 128 + signal : 0;
}

int fail(int code, const std::string& message) {
  say("{}", message);
  return code;
}

/// A wheel has this program twice. This one, for every processor, runs the one for wide vectors if
/// the processor has them; not with PYMLT_BUILD=baseline
/// (python/pymlt/_processor.py).
void give_way_to_wide_build([[maybe_unused]] char** argv) {
#ifdef MLT_WIDE_PROGRAM
  const char* asked = std::getenv("PYMLT_BUILD");
  const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi2");
  if (!wide || (asked && std::string(asked) == "baseline")) return;
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) execv((self.parent_path() / MLT_WIDE_PROGRAM).c_str(), argv);
#endif
}

int main(int argc, char** argv) {
  give_way_to_wide_build(argv);
  open_standard_streams();
  catch_signals();
  try {
    return run(parse(argc, argv));
  } catch (const RenderError& error) {
    return fail(3, error.what());
  } catch (const Error& error) {
    return fail(2, error.what());
  } catch (const std::bad_alloc&) {
    return fail(3, "out of memory");
  } catch (const std::exception& error) {
    return fail(3, error.what());
  }
}

}  // namespace
}  // namespace mlt

int main(int argc, char** argv) { return mlt::main(argc, argv); }

// mlt-render: the flags of `pymlt render`, without Python on the machine.
//
// Exit codes: 0 done; 2 a mistake in usage or in the scene, or an output that cannot be written;
// 3 the render failed; 130 and 143 interrupted by SIGINT or SIGTERM, with what was rendered saved.

#include "app/options.h"
#include "app/progress_line.h"
#include "image/atomic_file.h"
#include "mlt_version.h"
#include "render/output.h"
#include "render/plugins.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <csignal>
#include <exception>

namespace mlt {
namespace {

volatile std::sig_atomic_t caught_signal = 0;
volatile std::sig_atomic_t something_to_save = 0;

void on_signal(int signal) {
  if (!something_to_save) _exit(128 + signal);
  caught_signal = signal;
}

void declare(CLI::App& app, Options& options, std::vector<std::string>& parameters,
             std::vector<std::string>& defines, std::string& size) {
  app.add_option("scene", options.scene, "Mitsuba scene file (XML)")->required();
  app.add_option("-o,--output", options.outputs, "image file: .exr, .png or .hdr; may be repeated")
      ->required()
      ->allow_extra_args(false);
  app.add_option("--integrator", options.integrator, "algorithm, in place of the scene's own");
  app.add_option("-p", parameters, "integrator parameter, name=value")->allow_extra_args(false);
  app.add_option("-D", defines, "scene parameter, name=value")->allow_extra_args(false);
  app.add_option("--size", size, "image size in pixels, WIDTHxHEIGHT");
  app.add_option("--spp", options.render.budget.spp, "samples (or mutations) per pixel");
  app.add_option("--time", options.render.budget.seconds, "seconds to render");
  app.add_option("--seed", options.render.seed, "seed of all random numbers");
  app.add_option("--threads", options.render.threads, "0: as many as the machine has");
  app.add_option("--stats", options.stats, "write what the render tells about itself, as JSON");
  app.add_option("--exposure", options.exposure, "brighten PNG files by so many stops");
  app.add_flag("--quiet", options.quiet, "say nothing but errors");
  app.set_version_flag("--version", "mlt-render " MLT_VERSION);
}

/// Renders until the budget is used up or a signal arrives; returns the signal, or 0.
int render(Job& job, bool quiet) {
  ProgressLine line(quiet);
  something_to_save = 1;
  job.start();
  while (!job.wait(0.1)) {
    if (caught_signal) job.cancel();
    line.update(job.progress(), job.stats().spp_done);
  }
  return caught_signal;
}

/// Every output is tried, and elsewhere if it fails, before any error is reported.
void save(const Options& options, const RenderedImage& render, const Stats& stats,
          WriteOptions write) {
  write.exposure = options.exposure;
  std::exception_ptr failure;
  const auto attempt = [&](const std::string& path, const auto& save_as) {
    try {
      const std::string written = save_as();
      if (written != path)
        fmt::print(stderr, "mlt-render: {} could not be written; it is saved as {}\n", path,
                   written);
    } catch (const FileError&) {
      if (!failure) failure = std::current_exception();
    }
  };
  for (const std::string& path : options.outputs)
    attempt(path, [&] { return save_render(path, render, write); });
  if (!options.stats.empty())
    attempt(options.stats, [&] { return save_text(options.stats, to_json(stats)); });
  if (failure) std::rethrow_exception(failure);
}

int run(const Options& options) {
  for (const std::string& path : options.outputs) check_writable(path);
  if (!options.stats.empty()) check_file_writable(options.stats);
  const LoadedScene loaded = load_file(options.scene, plugins(), options.load);
  const MadeIntegrator made = make_integrator(
      choose_integrator(loaded, options.integrator, options.parameters, plugins()), plugins());
  Job job(loaded.scene, made.integrator, options.render);
  if (!options.quiet)
    for (const std::string& warning : render_stats(job, loaded, made).warnings)
      fmt::print(stderr, "mlt-render: warning: {}\n", warning);

  const int signal = render(job, options.quiet);
  const Stats stats = render_stats(job, loaded, made);
  if (signal && stats.spp_done == 0) {
    fmt::print(stderr, "mlt-render: interrupted before the first sample; nothing to save\n");
    return 128 + signal;
  }
  WriteOptions write;
  write.half = loaded.scene->film().half_precision;
  write.metadata = render_metadata(stats, made);
  save(options, {job.image(), job.layers()}, stats, write);
  if (!options.quiet)
    fmt::print(stderr, "mlt-render: {}{} x {}, {:.4g} spp in {:.1f} s: {}\n",
               signal ? "interrupted; " : "", stats.width, stats.height, stats.spp_done,
               stats.seconds_bootstrap + stats.seconds_render, fmt::join(options.outputs, ", "));
  return signal ? 128 + signal : 0;
}

int fail(int code, const std::string& message) {
  fmt::print(stderr, "mlt-render: {}\n", message);
  return code;
}

int main(int argc, char** argv) {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  Options options;
  std::vector<std::string> parameters, defines;
  std::string size;
  CLI::App app("Renders a Mitsuba scene, by path tracing or Metropolis light transport.");
  declare(app, options, parameters, defines, size);
  try {
    app.parse(argc, argv);
    for (const std::string& text : parameters)
      options.parameters.push_back(parse_assignment("-p", text));
    for (const std::string& text : defines) {
      const auto [name, value] = parse_assignment("-D", text);
      options.load.defines[name] = value;
    }
    if (!size.empty()) options.load.size = parse_size(size);
    return run(options);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(2, fmt::format("{}; see mlt-render --help", error.what()));
  } catch (const RenderError& error) {
    return fail(3, error.what());
  } catch (const Error& error) {
    return fail(2, error.what());
  } catch (const std::exception& error) {
    return fail(3, error.what());
  }
}

}  // namespace
}  // namespace mlt

int main(int argc, char** argv) { return mlt::main(argc, argv); }

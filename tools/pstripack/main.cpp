// pstripack: meshes on the sphere from the command line.

#include <fmt/format.h>

#include <new>

#include "base/parallel_for.h"
#include "files/nearest.h"
#include "files/output_file.h"
#include "pstripack/options.h"
#include "pstripack/progress.h"
#include "pstripack/ranks.h"
#include "standard_streams.h"

namespace {

constexpr auto kDescription = R"(Exact Delaunay triangulations and Voronoi diagrams of nodes on the sphere.

  pstripack points fibonacci 10000 -o nodes.nc
  pstripack info nodes.nc
  pstripack triangulate nodes.nc -o mesh.nc
  pstripack voronoi nodes.nc -o cells.vtu
  pstripack scvt 10242 --density bump -o mesh.mpas.nc
  pstripack interpolate stations.txt --to-grid 180x360 -o field.nc
  pstripack plot mesh.nc -o mesh.svg

`pstripack COMMAND --help` describes a command.)";

constexpr auto kFooter =
    R"(Input: text with `lon lat` or `x y z` on each line or a header line that names the columns (separated by blanks,
commas, semicolons or tabs; #, % and ! start comments, > a segment), OFF, GeoJSON of points, raw doubles, or NetCDF
(UGRID; xCell, yCell, zCell; lonCell, latCell; lon, lat). Angles that could be degrees or radians are refused unless
--units says which.

Output: a file, written completely or not at all, or stdout. Everything else goes to stderr. OMP_NUM_THREADS and
the affinity mask are honoured.

Exit code: 0 success; 1 the input cannot be used or the output cannot be written; 2 wrong command line.)";

/// The command line for the history of files, without options that do not change the result.
std::string history_of(int argc, char** argv) {
  std::string text = "pstripack";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--threads") ++i;
    if (word == "-q" || word == "--quiet" || word == "--serial" || word.rfind("--threads", 0) == 0) continue;
    text +=
        word.empty() || word.find_first_of(" \t\n'\"") != word.npos ? fmt::format(" '{}'", word) : " " + word;
  }
  return text + " (pstripack " PSTRIPACK_VERSION ")";
}

/// Names an unknown subcommand or option and the most similar one; empty: all exist.
std::string unknown_word(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  for (const std::string& word : app.remaining(true)) {
    std::vector<std::string> known;
    if (word.size() > 1 && word[0] == '-') {
      const std::string name = word.substr(0, word.find('='));
      std::vector<const CLI::App*> apps(chosen.begin(), chosen.end());
      apps.push_back(&app);
      for (const CLI::App* const a : apps)
        for (const CLI::Option* const option : a->get_options()) {
          for (const std::string& n : option->get_lnames()) known.push_back("--" + n);
          for (const std::string& n : option->get_snames()) known.push_back("-" + n);
        }
      return fmt::format("there is no option {}{}", name, files::did_you_mean(name, known));
    }
    if (!chosen.empty()) continue;
    for (const CLI::App* const sub : app.get_subcommands([](const CLI::App*) { return true; }))
      known.push_back(sub->get_name());
    const std::string meant = files::did_you_mean(word, known);
    return fmt::format("there is no subcommand '{}'{}", word,
                       meant.empty() ? fmt::format(": expected {}", fmt::join(known, ", ")) : meant);
  }
  return "";
}

/// Prints an error; only rank 0 prints. fmt::print would throw if stderr is full.
void complain(const char* what) {
  if (!program::global().is_led) std::fprintf(stderr, "pstripack: %s\n", what);
}

int run(int argc, char** argv) {
  using namespace program;
  global().command = history_of(argc, argv);
  CLI::App app(kDescription, "pstripack");
  app.footer(kFooter);
  app.set_version_flag("--version", "pstripack " PSTRIPACK_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  app.add_flag("-q,--quiet", global().quiet, "print only errors on stderr");
  option(app, "--threads NUMBER", global().threads, "number of threads [the free processors]")
      ->check(CLI::Range(1, 4096).description(""));
  add_serial(app);
  Command chosen;
  for (const auto add :
       {add_triangulate, add_voronoi, add_info, add_points, add_convert, add_scvt, add_interpolate, add_plot})
    add(app, chosen);
  try {
    app.parse(argc, argv);
    const pstripack::ChosenThreads threads(global().threads);
    chosen();
    expect_printed();
    return global().exit_code;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return after_help("pstripack", app.exit(e));  // --help, --version
    const std::string unknown = unknown_word(app);
    complain(unknown.empty() ? e.what() : unknown.c_str());
    return kUsage;
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& e) {
    complain(e.what());
  }
  return kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  fill_standard_streams();
  return program::on_rank_0(argc, argv, [&] { return run(argc, argv); });
}

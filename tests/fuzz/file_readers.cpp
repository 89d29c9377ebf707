// The readers of the tools on files of any bytes: they must return valid data or report the error in one
// line.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "files/nodes.h"
#include "input.h"
#include "list_files.h"
#include "mesh_files.h"

namespace {

/// A temporary folder.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("pstripack_fuzz_" + std::to_string(getpid()))) {
    std::filesystem::create_directory(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string write(const char* name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  std::string prefix() const { return (path_ / "mesh").string(); }

 private:
  std::filesystem::path path_;
};

template <class Read>
void read(const Read& read_it) {
  try {
    read_it();
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    require(!message.empty() && message.find('\n') == message.npos, "not one line: " + message);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  Input input(data, size);
  const int reader = input.below(3);
  const std::string text = input.rest();
  if (reader == 0) {
    const std::string file = folder.write("nodes.txt", text);
    read([&] {
      files::ReadOptions options;
      options.container = files::Container::text;
      options.units = files::Units::degrees;
      options.with_columns = true;
      const files::Nodes nodes = files::read(file, options);
      for (const files::Column& column : nodes.columns)
        require(column.size() == nodes.points.size(), "a column of another length than the nodes");
    });
  } else if (reader == 1) {
    const std::string file = folder.write("calls", text);
    read([&] {
      const auto next = comparison::calls_of(file);
      while (const auto call = next()) {
        const auto& lists = call->run.lists;
        require(lists.list.size() == lists.lptr.size(), "LIST and LPTR of different length");
        if (call->has_returned)
          require(call->nodes <= static_cast<std::size_t>(std::max<std::int64_t>(call->n, 0)),
                  "more nodes than n");
      }
    });
  } else {
    // Triangles of three valid nodes; or, behind a zero byte, triangles of the nodes before it.
    const std::size_t end = text.find('\0');
    folder.write("mesh_points.txt", end == text.npos ? "1 0 0\n0 1 0\n0 0 1\n" : text.substr(0, end));
    folder.write("mesh_triangles.txt", end == text.npos ? text : text.substr(end + 1));
    read([&] {
      const comparison::MeshFiles mesh = comparison::read_mesh(folder.prefix());
      for (const auto& t : mesh.triangles)
        for (const auto k : t)
          require(k >= 0 && static_cast<std::size_t>(k) < mesh.points.size(),
                  "a triangle of nodes that are not there");
      const auto same = comparison::compare_meshes(mesh, mesh);
      require(same.only_in_a == 0 && same.only_in_b == 0, "a mesh that differs from itself");
    });
  }
  return 0;
}

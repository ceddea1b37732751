// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/fe/vtk_result.h"

#include <fmt/format.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

/// VTK prints what its parts complain of among themselves; the sentence is ours.
class Silence : public vtkOutputWindow {
 public:
  static Silence* New() { return new Silence; }
  void DisplayText(const char*) override {}
};

/// Sees the errors of a reader.
class ErrorCatcher : public vtkCommand {
 public:
  static ErrorCatcher* New() { return new ErrorCatcher; }
  void Execute(vtkObject*, unsigned long, void*) override { seen = true; }
  bool seen = false;
};

struct TimedFile {
  std::filesystem::path file;
  std::optional<double> time;
};

vtkSmartPointer<vtkUnstructuredGrid> readGrid(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) {
    throw InputError({file, ""}, "cannot be read; allowed: a .vtu of VTK.");
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  vtkNew<ErrorCatcher> errors;
  for (const unsigned long event : {vtkCommand::ErrorEvent, vtkCommand::WarningEvent}) {
    reader->AddObserver(event, errors);
  }
  reader->SetReaderErrorObserver(errors);
  reader->SetParserErrorObserver(errors);
  reader->SetFileName(file.c_str());
  if (reader->CanReadFile(file.c_str()) == 0) {
    throw InputError({file, ""}, "is not an unstructured grid of VTK; allowed: a .vtu file.");
  }
  reader->Update();
  if (errors->seen || reader->GetOutput() == nullptr || reader->GetOutput()->GetNumberOfPoints() == 0) {
    throw InputError({file, ""}, "is cut off or damaged, or holds no point; allowed: a whole .vtu file.");
  }
  return reader->GetOutput();
}

std::string joinedNames(vtkPointData* data) {
  std::vector<std::string> names;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    if (data->GetArrayName(i) != nullptr) names.emplace_back(data->GetArrayName(i));
  }
  return names.empty() ? "none" : joinedList(names);
}

vtkDataArray* numbering(vtkPointData* data) {
  if (vtkDataArray* ids = data->GetGlobalIds()) return ids;
  for (const char* name : {"GlobalIds", "GlobalNodeId", "node_id", "NodeId", "node_ids", "node"}) {
    vtkDataArray* ids = data->GetArray(name);
    if (ids != nullptr && ids->GetNumberOfComponents() == 1) return ids;
  }
  return nullptr;
}

class VtkReader : public FeResultReader {
 public:
  VtkReader(const std::filesystem::path& file, std::string array) : file_(file), array_(std::move(array)) {
    if (file.extension() == ".pvd") {
      readSeries();
    } else {
      files_.push_back({file, std::nullopt});
    }
  }

  [[nodiscard]] FeMesh mesh() const override {
    FeMesh mesh;
    const auto grid = readGrid(files_.front().file);
    vtkPointData* data = grid->GetPointData();
    vtkDataArray* ids = numbering(data);
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
      double p[3];
      grid->GetPoint(i, p);
      mesh.nodes[idOf(ids, i)] = {p[0], p[1], p[2]};
    }
    for (int a = 0; a < data->GetNumberOfArrays(); ++a) {
      vtkDataArray* array = data->GetArray(a);
      if (array == nullptr || array == ids || array->GetName() == nullptr || array->GetNumberOfComponents() != 1)
        continue;
      if (array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE) continue;
      const double* range = array->GetRange();
      if (range[0] < 0.0 || range[1] != 1.0) continue;
      std::vector<NodeId>& members = mesh.sets[setName(array->GetName())];
      for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
        if (array->GetComponent(i, 0) == 1.0) members.push_back(idOf(ids, i));
      }
    }
    return mesh;
  }

  [[nodiscard]] std::vector<FeState> states(const std::set<NodeId>& wanted) const override {
    std::vector<FeState> out;
    for (const TimedFile& one : files_) {
      const auto grid = readGrid(one.file);
      vtkPointData* data = grid->GetPointData();
      vtkDataArray* u = displacements(one.file, data);
      vtkDataArray* ids = numbering(data);
      FeState state;
      state.time = one.time ? *one.time : fieldTime(grid);
      for (vtkIdType i = 0; i < u->GetNumberOfTuples(); ++i) {
        const NodeId id = idOf(ids, i);
        if (!wanted.contains(id)) continue;
        state.displacement[id] = {u->GetComponent(i, 0), u->GetComponent(i, 1), u->GetComponent(i, 2)};
      }
      out.push_back(std::move(state));
    }
    return out;
  }

 private:
  static NodeId idOf(vtkDataArray* ids, vtkIdType i) {
    return ids == nullptr ? static_cast<NodeId>(i) : static_cast<NodeId>(std::llround(ids->GetComponent(i, 0)));
  }

  static double fieldTime(vtkUnstructuredGrid* grid) {
    vtkDataArray* time = grid->GetFieldData()->GetArray("TimeValue");
    return time != nullptr && time->GetNumberOfTuples() > 0 ? time->GetComponent(0, 0) : 0.0;
  }

  [[nodiscard]] vtkDataArray* displacements(const std::filesystem::path& file, vtkPointData* data) const {
    std::vector<std::string> names{array_};
    if (array_.empty())
      names = {"U", "u", "DISP", "Displacement", "displacement", "DISPLACEMENT", "displacements", "disp"};
    for (const std::string& name : names) {
      vtkDataArray* found = data->GetArray(name.c_str());
      if (found == nullptr) continue;
      if (found->GetNumberOfComponents() != 3) {
        throw InputError({file, ""}, fmt::format("point array \"{}\" has {} components; allowed: three displacements.",
                                                 name, found->GetNumberOfComponents()));
      }
      return found;
    }
    throw InputError(
        {file, ""},
        fmt::format("has no point array {}; allowed: \"displacement\" (--displacement) with the name of one of "
                    "its arrays: {}.",
                    array_.empty() ? "of displacements (U, DISP, displacement)" : "\"" + array_ + "\"",
                    joinedNames(data)));
  }

  void readSeries() {
    // A .pvd is XML: <VTKFile><Collection><DataSet timestep="900" file="a.vtu"/>...
    if (!std::filesystem::is_regular_file(file_))
      throw InputError({file_, ""}, "cannot be read; allowed: a .pvd of VTK.");
    vtkNew<vtkXMLDataParser> parser;
    vtkNew<ErrorCatcher> errors;
    parser->AddObserver(vtkCommand::ErrorEvent, errors);
    parser->AddObserver(vtkCommand::WarningEvent, errors);
    parser->SetFileName(file_.c_str());
    const bool read = parser->Parse() != 0 && !errors->seen && parser->GetRootElement() != nullptr;
    vtkXMLDataElement* collection = read ? parser->GetRootElement()->FindNestedElementWithName("Collection") : nullptr;
    if (collection == nullptr) {
      throw InputError({file_, ""},
                       "is not a collection of VTK files; allowed: a .pvd with <Collection> and <DataSet>.");
    }
    for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
      vtkXMLDataElement* set = collection->GetNestedElement(i);
      if (std::string(set->GetName()) != "DataSet") continue;
      const char* name = set->GetAttribute("file");
      const char* timestep = set->GetAttribute("timestep");
      double time = 0.0;
      if (name == nullptr || timestep == nullptr || !parseNumber(trimmed(timestep), time)) {
        throw InputError({file_, fmt::format("DataSet {}", i + 1)},
                         "lacks its file or its time; allowed: <DataSet timestep=\"900\" file=\"a.vtu\"/>.");
      }
      const std::filesystem::path path(name);
      if (path.extension() != ".vtu") {
        throw InputError({file_, fmt::format("DataSet {}", i + 1)},
                         fmt::format("\"{}\" is not a .vtu file; allowed: unstructured grids in one piece.", name));
      }
      files_.push_back({path.is_absolute() ? path : file_.parent_path() / path, time});
    }
    if (files_.empty()) throw InputError({file_, ""}, "names no file; allowed: at least one <DataSet>.");
  }

  std::filesystem::path file_;
  std::string array_;
  std::vector<TimedFile> files_;
};

}  // namespace

std::unique_ptr<FeResultReader> openVtkResult(const std::filesystem::path& file,
                                              const std::string& displacement_array) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<Silence> silence;
  vtkOutputWindow::SetInstance(silence);
  return std::make_unique<VtkReader>(file, displacement_array);
}

}  // namespace spindrift

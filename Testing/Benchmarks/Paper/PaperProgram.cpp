// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CudaDevice.h"
#include "Experiments.h"
#include "Machine.h"
#include "PaperSurfaces.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <stdexcept>

/// @file
/// delaunay-flip-paper: the experiments of the paper, one at a time, as JSON. reproduce_paper.sh
/// runs them all.

namespace delaunayflip
{
namespace
{

struct PaperArguments
{
  ExperimentSettings Settings;
  std::string Output;
  std::string Mesh;
  std::string Name;
  std::int64_t Points = 100000;
  std::vector<std::int64_t> Triangles = { 6, 10, 100, 1000 };
  std::vector<double> Epsilons = { 1e-7, 1e-6, 1e-5, 1e-4, 1e-3 };
  std::vector<double> FeatureAngles = { 20.0, 30.0, 60.0, 180.0 };
  ProgramList Programs;
  double Threshold = 30.0;
};

Json Describe() { return { { "machine", DescribeMachine() }, { "gpu", HasCudaDevice() } }; }

void Write(const PaperArguments& arguments, const Json& json)
{
  if (arguments.Output.empty())
  {
    std::cout << json.dump(1) << "\n";
    return;
  }
  std::ofstream file(arguments.Output);
  if (!(file << json.dump(1) << std::endl))
  {
    throw std::runtime_error("cannot write " + arguments.Output);
  }
}

void WriteRows(const PaperArguments& arguments, const Json& rows)
{
  Json json = Describe();
  json["rows"] = rows;
  Write(arguments, json);
}

/// Writes x and y of a random bad mesh's points in single precision, for other programs.
void WritePoints(const PaperArguments& arguments)
{
  const OwnedMesh<float> mesh = MakePaperRandomMesh(arguments.Points);
  std::ofstream file(arguments.Output, std::ios::binary);
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    file.write(reinterpret_cast<const char*>(&mesh.Points[i]), 2 * sizeof(float));
  }
  if (!file.flush())
  {
    throw std::runtime_error("cannot write " + arguments.Output);
  }
}

void WriteTorus(const PaperArguments& arguments, bool isNoisy)
{
  const double side = std::sqrt(static_cast<double>(arguments.Points) / 2.0);
  const auto rows = static_cast<std::int32_t>(side);
  const auto columns = static_cast<std::int32_t>(static_cast<double>(arguments.Points) / rows);
  OwnedMesh<double> mesh = MakeBumpyTorus(columns, rows, 0.4, 1);
  if (isNoisy)
  {
    AddNoise(mesh, 0.6 / side, 2);
  }
  WriteMeshFile(RoundToFloats(mesh), arguments.Output);
}

CLI::App* AddCommand(
  CLI::App& app, const std::string& name, const std::string& help, const std::function<void()>& run)
{
  CLI::App* command = app.add_subcommand(name, help);
  command->callback(run);
  return command;
}

void AddExperiments(CLI::App& app, PaperArguments& a)
{
  const auto points = [&](CLI::App* command)
  {
    return command->add_option("--points", a.Points, "of the mesh")
      ->check(CLI::Range(4, 500000000));
  };
  AddCommand(app, "chain", "Fig. 6: the worst case",
    [&] { WriteRows(a, RunChain(a.Settings, a.Triangles)); })
    ->add_option("--triangles", a.Triangles, "even numbers, 4 and more")
    ->delimiter(',');
  CLI::App* random = AddCommand(app, "random", "Figs. 8a and 9: a random bad mesh",
    [&] { WriteRows(a, RunRandom(a.Settings, a.Points, a.Programs)); });
  points(random);
  random->add_option("--programs", a.Programs, "which run; default: all")->delimiter(',');
  CLI::App* quality = AddCommand(app, "quality", "Fig. 8b: triangles that differ from CGAL's",
    [&] { WriteRows(a, RunQuality(a.Settings, a.Points, a.Epsilons)); });
  points(quality);
  quality->add_option("--epsilons", a.Epsilons, "of the paper's method")->delimiter(',');
  CLI::App* compare = AddCommand(app, "compare", "a file of 32-bit ids against CGAL's triangles",
    [&] { WriteRows(a, RunComparison(a.Points, a.Mesh)); });
  points(compare);
  compare->add_option("--file", a.Mesh, "the file")->required();
  CLI::App* surface = AddCommand(app, "surface", "Fig. 11 and Table 2: a surface",
    [&] { WriteRows(a, RunSurface(a.Settings, a.Mesh, a.Threshold)); });
  surface->add_option("--mesh", a.Mesh, "a .dfmesh file")->required();
  surface->add_option("--threshold", a.Threshold, "of normals, in degrees");
  CLI::App* tests = AddCommand(app, "tests", "in-circle against opposite angles",
    [&] { WriteRows(a, RunTests(a.Settings, a.Name, a.Points)); });
  points(tests);
  tests->add_option("--mesh", a.Name, "random, grid, circles or offset")->required();
  CLI::App* asItIs = AddCommand(app, "as-it-is", "the same for a surface of a file",
    [&] { WriteRows(a, RunAsItIs(a.Settings, a.Mesh, a.FeatureAngles)); });
  asItIs->add_option("--mesh", a.Mesh, "a .dfmesh file")->required();
  asItIs->add_option("--feature-angles", a.FeatureAngles, "in degrees")->delimiter(',');
  CLI::App* ruined = AddCommand(app, "ruined", "surfaces of bad quality",
    [&] { WriteRows(a, RunRuined(a.Settings, a.Name, a.Points, a.FeatureAngles)); });
  points(ruined);
  ruined->add_option("--kind", a.Name, "flips, splits or anisotropic")->required();
  ruined->add_option("--feature-angles", a.FeatureAngles, "in degrees")->delimiter(',');
}

void AddFiles(CLI::App& app, PaperArguments& a)
{
  AddCommand(app, "machine", "the machine", [&] { Write(a, Describe()); });
  AddCommand(app, "points", "writes the points of a random bad mesh", [&] { WritePoints(a); })
    ->add_option("--points", a.Points, "how many");
  AddCommand(app, "torus", "writes a bumpy torus", [&] { WriteTorus(a, false); })
    ->add_option("--points", a.Points, "how many");
  AddCommand(app, "noisy-torus", "writes one with noise", [&] { WriteTorus(a, true); })
    ->add_option("--points", a.Points, "how many");
}

int Run(int argc, char** argv)
{
  PaperArguments arguments;
  CLI::App app("The experiments of Navarro, Hitschfeld and Scheihing (2013), as JSON");
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--output", arguments.Output, "a file; default: standard output");
  app.add_option("--repetitions", arguments.Settings.Repetitions, "of what is timed");
  app.add_option("--seconds", arguments.Settings.Seconds, "after which none is begun");
  app.add_flag("--gpu", arguments.Settings.OnGpu, "use the GPU, too");
  app.add_flag("!--no-times", arguments.Settings.HasTimes, "run everything once, without times");
  AddExperiments(app, arguments);
  AddFiles(app, arguments);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error);
  }
  return 0;
}

}
}

int main(int argc, char** argv)
{
  try
  {
    return delaunayflip::Run(argc, argv);
  }
  catch (const std::exception& error)
  {
    std::cerr << "delaunay-flip-paper: " << error.what() << "\n";
    return 1;
  }
}

// SPDX-License-Identifier: GPL-2.0-or-later
// What a search on the faces of a CAD file takes beside OpenCASCADE's distance, in turns, by the processor's
// time: step_cost FILE; step_cost --read FILE reads it as OpenCASCADE does with names and colours, and
// nothing else.
#include <fmt/format.h>
#include <malloc.h>

#include <STEPCAFControl_Reader.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFApp_Application.hxx>
#include <algorithm>
#include <ctime>
#include <exception>
#include <random>

#include "brep/face_shape.h"
#include "brep/foot_search.h"
#include "cad_wall.h"
#include "occt_judge.h"
#include "read_plainly.h"

namespace {

using brep::Vector3;

double processor_time() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double>& values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

class Cost {
 public:
  explicit Cost(const std::string& file) : judge_(file), wall_(wall_of(file)), search_(wall_) {}

  /// Points of faces, moved by up to `off` of the size in each direction; each in turn for so many other
  /// points.
  void compare(const char* what, double off) {
    constexpr int kBlocks = 4, kPoints = 1000;
    std::vector<double> all, nearest, theirs;
    std::mt19937 random(7);
    for (int block = 0; block < kBlocks; ++block) {
      std::vector<Vector3> points;
      std::vector<double> distances;
      for (int k = 0; k < kPoints; ++k) {
        points.push_back(point(random, off));
        const Vector3& d = points.back();
        const double start = processor_time();
        distances.push_back(judge_.nearest({d[0], d[1], d[2]}).distance);
        theirs.push_back(processor_time() - start);
      }
      for (const bool of_all : {block % 2 == 0, block % 2 != 0})
        for (int k = 0; k < kPoints; ++k)
          (of_all ? all : nearest).push_back(time_of(points[k], (of_all ? 2.0 : 1.001) * distances[k]));
    }
    const auto mean = [](const std::vector<double>& values) {
      return 1e6 * std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    };
    const double of_all = mean(all), of_nearest = mean(nearest), extrema = mean(theirs);
    fmt::print(
        "{}: all feet nearer than twice the distance {:.2f} us, the nearest alone {:.2f}, BRepExtrema "
        "{:.0f}: 1/{:.0f} and 1/{:.0f} (medians 1/{:.0f} and 1/{:.0f})\n",
        what, of_all, of_nearest, extrema, extrema / of_all, extrema / of_nearest,
        median(theirs) / median(all), median(theirs) / median(nearest));
  }

 private:
  static brep::Surface wall_of(const std::string& file) {
    const brep::CadModel model = step_parts::model_of(file);
    malloc_trim(0);
    const auto before = mallinfo2().uordblks;
    brep::Surface wall = step_parts::wall_of(model);
    const brep::FootSearch search(wall);
    fmt::print("{} faces, {} edges: {:.2f} MiB with the search\n", wall.faces.size(), wall.edges.size(),
               static_cast<double>(mallinfo2().uordblks - before) / 1048576.0);
    for (brep::Face& face : wall.faces) face.outward = 0;
    return wall;
  }

  double time_of(const Vector3& d, double reach) {
    const double start = processor_time();
    near_.clear(), feet_.clear();
    search_.near(d, reach, near_);
    search_.feet(d, reach, near_.data(), static_cast<int>(near_.size()), feet_);
    return processor_time() - start;
  }

  Vector3 point(std::mt19937& random, double off) const {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (;;) {
      const auto face = static_cast<int>(random() % wall_.faces.size());
      const brep::TrimDomain& domain = wall_.domains[face];
      brep::Parameter<2> xi;
      for (int i = 0; i < 2; ++i)
        xi[i] = domain.low()[i] + (0.5 + 0.5 * uniform(random)) * (domain.high()[i] - domain.low()[i]);
      if (domain.inside(xi))
        return brep::point_on(wall_, face, xi) +
               off * wall_.size * Vector3(uniform(random), uniform(random), uniform(random));
    }
  }

  step_parts::OcctJudge judge_;
  brep::Surface wall_;
  brep::FootSearch search_;
  std::vector<int> near_;
  std::vector<brep::Foot> feet_;
};

void read_alone(const std::string& file) {
  step_parts::silence();
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  STEPCAFControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone || !reader.Transfer(document))
    throw std::runtime_error(file + ": cannot be read");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() == 2 && words[0] == "--read") {
      read_alone(words[1]);
    } else if (words.size() == 1) {
      Cost cost(words[0]);
      cost.compare("within 0.005 of the size", 0.005);
      cost.compare("within 0.02 of the size", 0.02);
    } else {
      fmt::print(stderr, "usage: step_cost FILE | --read FILE\n");
      return 2;
    }
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

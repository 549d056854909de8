// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cad/library.hpp"

#include <APIHeaderSection_MakeHeader.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_StepModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Shape.hxx>
#include <mutex>
#include <new>
#include <velum/files.hpp>

namespace velum::cad {
namespace {

Handle(TCollection_HAsciiString) text(const std::string& value) {
  return new TCollection_HAsciiString(value.c_str());
}

/// The library stamps files with the time, its version and the host; ours are the same every time.
void set_step_header(STEPControl_Writer& writer, const std::string& name) {
  APIHeaderSection_MakeHeader header(writer.Model());
  header.SetName(text(name));
  header.SetTimeStamp(text("1970-01-01T00:00:00"));
  header.SetAuthorValue(1, text(""));
  header.SetOrganizationValue(1, text(""));
  header.SetOriginatingSystem(text("Velum"));
  header.SetAuthorisation(text(""));
}

/// The library adds the number of parts that it has written so far.
void name_products(const StepData_StepModel& model, const std::string& name) {
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(StepBasic_Product) product = Handle(StepBasic_Product)::DownCast(model.Value(i));
    if (product.IsNull()) continue;
    product->SetId(text(name));
    product->SetName(text(name));
  }
}

void write_step(const TopoDS_Shape& shape, const std::string& path, const std::string& name) {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", "MM");
  Interface_Static::SetCVal("write.step.product.name", name.c_str());
  STEPControl_Writer writer;
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone)
    throw Error(Fault::stage, "OpenCASCADE cannot express the surface in STEP");
  set_step_header(writer, name);
  name_products(*writer.Model(), name);
  writer.Write(path.c_str());
}

void write_iges(const TopoDS_Shape& shape, const std::string& path, const std::string& name) {
  constexpr int kFaces = 0;  // as trimmed surfaces (entity 144), which every reader knows
  IGESControl_Writer writer("MM", kFaces);
  if (!writer.AddShape(shape))
    throw Error(Fault::stage, "OpenCASCADE cannot express the surface in IGES");
  writer.ComputeModel();
  IGESData_GlobalSection section = writer.Model()->GlobalSection();
  section.SetSendName(text(name));
  section.SetFileName(text(name));
  section.SetDate(text("19700101.000000"));
  section.SetLastChangeDate(text("19700101.000000"));
  section.SetAuthorName(text(""));
  section.SetCompanyName(text(""));
  section.SetSystemId(text("Velum"));
  section.SetInterfaceVersion(text("Velum"));
  writer.Model()->SetGlobalSection(section);
  writer.Write(path.c_str());
}

/// The library's parsers are not asked to read half a file.
void check_whole(const std::filesystem::path& path, Exchange format) {
  const FileContent content(path);
  constexpr std::size_t kLine = 81;
  const std::string_view all = content.text();
  const std::string_view tail = all.substr(all.size() - std::min(all.size(), kLine));
  const bool whole = format == Exchange::step
                         ? tail.find("END-ISO-10303-21;") != std::string_view::npos
                         : tail.size() == kLine && tail[72] == 'T';
  if (!whole)
    throw Error(Fault::output, "the file ends before it should: was the disk full?")
        .at(path.string());
}

template <class Reader>
void read_all(const std::filesystem::path& path, Fault fault, TopoDS_Shape& shape) {
  Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone || reader.TransferRoots() < 1)
    throw Error(fault, fault == Fault::output
                           ? "the file that was written cannot be read back"
                           : "OpenCASCADE finds no shape in the file that it understands")
        .at(path.string());
  shape = reader.OneShape();
}

}  // namespace

void guarded(Fault fault, const std::string& what, const std::function<void()>& call) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  try {
    call();
  } catch (const Standard_Failure& failure) {
    const char* message = failure.GetMessageString();
    const char* type = failure.DynamicType()->Name();
    throw Error(fault, what + " failed in OpenCASCADE: " +
                           (message != nullptr && *message != '\0' ? message : type));
  }
}

void write_shape(const TopoDS_Shape& shape, Exchange format, const std::filesystem::path& path,
                 const std::string& name) {
  if (format == Exchange::step)
    write_step(shape, path.string(), name);
  else
    write_iges(shape, path.string(), name);
}

void transfer(const std::filesystem::path& path, Exchange format, Fault fault,
              TopoDS_Shape& shape) {
  if (format == Exchange::step)
    read_all<STEPControl_Reader>(path, fault, shape);
  else
    read_all<IGESControl_Reader>(path, fault, shape);
}

void read_shape(const std::filesystem::path& path, Exchange format, TopoDS_Shape& shape) {
  check_whole(path, format);
  transfer(path, format, Fault::output, shape);
}

}  // namespace velum::cad

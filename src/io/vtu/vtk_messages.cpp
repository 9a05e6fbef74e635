// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtu/vtk_messages.hpp"

#include <algorithm>

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkObject.h>

namespace tessera::io {
namespace {

void append_message(vtkObject* /*caller*/, unsigned long /*event*/, void* text, void* message)
{
  if (message == nullptr) return;
  std::string line(static_cast<const char*>(message));
  std::ranges::replace(line, '\n', ' ');
  line.erase(line.find_last_not_of(' ') + 1);
  static_cast<std::string*>(text)->append(line);
}

}  // namespace

VtkMessages::VtkMessages(vtkObject& object) : object_(object)
{
  const vtkNew<vtkCallbackCommand> command;
  command->SetCallback(append_message);
  command->SetClientData(&text_);
  observers_ = {object_.AddObserver(vtkCommand::ErrorEvent, command),
                object_.AddObserver(vtkCommand::WarningEvent, command)};
}

VtkMessages::~VtkMessages()
{
  for (const unsigned long observer : observers_) object_.RemoveObserver(observer);
}

}  // namespace tessera::io

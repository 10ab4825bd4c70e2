"""A CiA 402 drive on canopen's stack, which a test of the core talks to over its pipes.

Its states and transitions are those of canopen's own 402 profile. A line `ID#BYTES` in hexadecimal
is a frame, to the drive on standard input and from it on standard output. An empty line ends a
cycle: the drive then sends TPDO 1 and an empty line. `!` is a fault in the drive.
"""

import sys

import canopen
from canopen.objectdictionary import ODRecord, ODVariable, ObjectDictionary, datatypes
from canopen.profiles.p402 import State402

NODE = 3
U8, U16, U32 = datatypes.UNSIGNED8, datatypes.UNSIGNED16, datatypes.UNSIGNED32
I8, I16, I32 = datatypes.INTEGER8, datatypes.INTEGER16, datatypes.INTEGER32

OBJECTS = {
    0x6040: ("Controlword", U16),
    0x6041: ("Statusword", U16),
    0x6060: ("Modes of operation", I8),
    0x6061: ("Modes of operation display", I8),
    0x6064: ("Position actual value", I32),
    0x607A: ("Target position", I32),
    0x60B1: ("Velocity offset", I32),
    0x60B2: ("Torque offset", I16),
}

# COB-ID and what is mapped, as the firmware sends and expects it.
RECEIVED = [(0x200, [0x607A, 0x60B1]), (0x300, [0x60B2]), (0x400, [0x6040, 0x6060])]
SENT = [(0x180, [0x6041, 0x6064, 0x6061])]

SIZES = {U8: 8, I8: 8, U16: 16, I16: 16, U32: 32, I32: 32}

# The controlword without what belongs to the mode, for the tables of canopen.
COMMAND = 0x8F


def record(index, name, members):
    made = ODRecord(name, index)
    for sub, (title, kind, value) in enumerate(members):
        member = ODVariable(title, index, sub)
        member.data_type, member.default, member.value = kind, value, value
        member.access_type = "rw"
        made.add_member(member)
    return made


def dictionary():
    objects = ObjectDictionary()
    objects.node_id = NODE
    for index, (name, kind) in OBJECTS.items():
        variable = ODVariable(name, index)
        variable.data_type, variable.default, variable.value = kind, 0, 0
        variable.access_type, variable.pdo_mappable = "rw", True
        objects.add_object(variable)
    period = [("Entries", U8, 2), ("Value", U8, 1), ("Index", I8, -3)]
    objects.add_object(record(0x60C2, "Interpolation time period", period))
    for base, pdos in ((0x1400, RECEIVED), (0x1800, SENT)):
        for number, (function, mapped) in enumerate(pdos):
            members = [("Entries", U8, 2), ("COB-ID", U32, function + NODE), ("Type", U8, 255)]
            objects.add_object(record(base + number, f"PDO {base + number:x}", members))
            entries = [
                ("", U32, index << 16 | SIZES[OBJECTS[index][1]]) for index in mapped
            ]
            entries.insert(0, ("Entries", U8, len(mapped)))
            for place, (_, kind, value) in enumerate(entries):
                entries[place] = (f"Entry {place}", kind, value)
            objects.add_object(record(base + 0x200 + number, f"Map {base + number:x}", entries))
    return objects


class Lines:
    """The bus: what is sent on it becomes a line."""

    channel_info = "standard output"

    def send(self, message, timeout=None):
        print(f"{message.arbitration_id:03x}#{message.data.hex()}")

    def shutdown(self):
        pass


class Drive:
    def __init__(self):
        self.network = canopen.Network()
        self.network.bus = Lines()
        self.node = canopen.LocalNode(NODE, dictionary())
        self.network.add_node(self.node)
        self.node.rpdo.read()
        self.node.tpdo.read()
        self.state = "SWITCH ON DISABLED"
        self.before = 0
        self.node.sdo[0x6064].raw = -123456

    def hear(self, identifier, data):
        self.network.notify(identifier, bytearray(data), 0.0)
        for number, (function, mapped) in enumerate(RECEIVED, 1):
            if identifier == function + NODE:
                for index, variable in zip(mapped, self.node.rpdo[number].map):
                    self.node.sdo[index].raw = variable.raw
                if 0x6040 in mapped:
                    self.control(self.node.sdo[0x6040].raw & COMMAND)

    def control(self, command):
        """Takes the transition that canopen's table has for the controlword, if it has one."""
        rising = command & 0x80 and not self.before & 0x80
        self.before = command
        allowed = {
            target
            for (origin, target), word in State402.TRANSITIONTABLE.items()
            if origin == self.state and word & COMMAND == command
        }
        if self.state == "FAULT" and not rising:
            allowed = set()
        automatic = {"SWITCH ON DISABLED", "NOT READY TO SWITCH ON", "FAULT"}
        if command == 0 and self.state not in automatic:
            allowed = {"SWITCH ON DISABLED"}
        if allowed:
            (self.state,) = allowed

    def cycle(self):
        node = self.node
        if self.state == "OPERATION ENABLED":
            node.sdo[0x6064].raw = node.sdo[0x607A].raw
        node.sdo[0x6061].raw = node.sdo[0x6060].raw
        _, bits = State402.SW_MASK[self.state]
        # Voltage, remote and what the mode makes of its own bits.
        node.sdo[0x6041].raw = bits | 0x1210
        for index, variable in zip(SENT[0][1], node.tpdo[1].map):
            variable.raw = node.sdo[index].raw
        node.tpdo[1].transmit()


def main():
    drive = Drive()
    for line in sys.stdin:
        line = line.strip()
        if line == "!":
            drive.state = "FAULT"
        elif line:
            identifier, data = line.split("#")
            drive.hear(int(identifier, 16), bytes.fromhex(data))
        else:
            drive.cycle()
            print(flush=True)


if __name__ == "__main__":
    main()
